"""Known errors, put into a perfect profile: heights, places, shapes, flags.

The measured value of each follows from the definition of the measure and from the IRI filter;
nothing is taken from the checks.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from floatref.measures import iri_trace
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.interface import Taken
from floatref_conformance.selftest.grading import AddError

Window = Callable[[FloatArray], FloatArray]
"""Returns the share of an error, 0 to 1, at each place in m."""
OTHER_SEED = 5
RUN_UP_M = 60.0
"""Length in m between the begin of an error and the scored stretch, so that the car settles."""
RAMP_M = 5.0


def everywhere(x: FloatArray) -> FloatArray:
    """Return 1 for every place."""
    return np.ones_like(x)


def between(start_m: float, end_m: float) -> Window:
    """Return 1 from ``start_m`` to ``end_m``, less over `RAMP_M` outside, 0 elsewhere."""
    corners = [start_m - RAMP_M, start_m, end_m, end_m + RAMP_M]
    return lambda x: np.interp(x, corners, [0.0, 1.0, 1.0, 0.0])


def limit_to_labels(add_error: AddError, *labels: str) -> AddError:
    """Return ``add_error``, limited to the recordings of a case with one of ``labels``."""

    def some(profile: Profile, taken: Taken, label: str) -> Profile:
        return add_error(profile, taken, label) if label in labels else profile

    return some


def make_higher(share: float, where: Window = everywhere) -> AddError:
    """Return an error that multiplies elevations, and so every roughness, by 1 + ``share``."""
    return _elevation(lambda z, x: z * (1.0 + share * where(x)))


def displace(by_m: Callable[[FloatArray], FloatArray]) -> AddError:
    """Return an error that moves features at x forward by ``by_m(x)``."""

    def move(z: FloatArray, x: FloatArray) -> FloatArray:
        return np.interp(x, x + by_m(x), z)

    return _elevation(move)


def move_features(length_m: float) -> AddError:
    """Return an error that moves every feature forward by ``length_m``."""
    return displace(lambda x: np.full(x.size, length_m))


def add_shape(shape: Callable[[FloatArray], FloatArray]) -> AddError:
    """Return an error that adds ``shape`` of the place, in m."""
    return _elevation(lambda z, x: z + shape(x))


def flag_points(start_m: float, end_m: float) -> AddError:
    """Return an error that flags the points from ``start_m`` to ``end_m``."""

    def flag(profile: Profile, taken: Taken, label: str) -> Profile:
        inside = (profile.distance_m >= start_m) & (profile.distance_m < end_m)
        return _each(profile, lambda t: ProfileTrack.of(t.name, t.elevation, t.valid & ~inside))

    return flag


def flag_end(length_m: float) -> AddError:
    """Return an error that flags the last ``length_m``."""

    def flag(profile: Profile, taken: Taken, label: str) -> Profile:
        end_m = profile.start_m + profile.length_m
        return flag_points(end_m - length_m, end_m + 1.0)(profile, taken, label)

    return flag


def chain(*errors: AddError) -> AddError:
    """Return ``errors``, applied one after another."""

    def add_error(profile: Profile, taken: Taken, label: str) -> Profile:
        for one in errors:
            profile = one(profile, taken, label)
        return profile

    return add_error


def make_rougher(
    m_per_km: float, start_m: float, end_m: float, where: Window = everywhere
) -> AddError:
    """Return an error that adds ``m_per_km`` to the IRI from ``start_m`` to ``end_m``.

    It multiplies the elevations, weighted by ``where``, by the required factor.
    """

    def roughen(profile: Profile, taken: Taken, label: str) -> Profile:
        x = profile.distance_m[:-1]
        inside = (x >= start_m) & (x <= end_m)
        track = profile.tracks[0]
        rectified = np.abs(iri_trace(track.elevation, profile.interval_m))
        share = m_per_km / float(np.mean((rectified * where(x))[inside]))
        return make_higher(share, where)(profile, taken, label)

    return roughen


def change_locally(m_per_km: float, at_m: float, base_m: float) -> AddError:
    """Return an error that changes the IRI filter's output from ``at_m`` on.

    Its largest mean change over ``base_m`` is ``m_per_km``.
    """
    where = between(at_m, at_m + base_m)

    def change(profile: Profile, taken: Taken, label: str) -> Profile:
        track = profile.tracks[0]
        part = iri_trace(track.elevation * where(profile.distance_m), profile.interval_m)
        count = round(base_m / profile.interval_m)
        means = np.convolve(np.abs(part), np.full(count, 1.0 / count), mode="valid")
        return make_higher(m_per_km / float(means.max()), where)(profile, taken, label)

    return change


def mix_in_road(loss: float, start_m: float, end_m: float) -> AddError:
    """Return an error that mixes in another road, so that (2.16) is 1 - ``loss``.

    The standard deviation of the IRI filter's output does not change; the share of the other road
    is orthogonal to that of the true road.
    """
    where = between(start_m - RUN_UP_M, end_m)

    def mix(profile: Profile, taken: Taken, label: str) -> Profile:
        x = profile.distance_m
        road = other_road(x.size, profile.interval_m)
        other = where(x) * (road - road[int(np.argmax(where(x) > 0.0))])
        inside = (x[:-1] >= start_m) & (x[:-1] <= end_m)

        def mix_track(track: ProfileTrack) -> ProfileTrack:
            z = track.elevation
            true, strange = (_deviation(v, profile.interval_m, inside) for v in (z, other))
            along = float(true @ strange / (true @ true))
            aside = float(np.linalg.norm(strange - along * true) / np.linalg.norm(true))
            share = float(np.sqrt(1.0 - (1.0 - loss) ** 2)) / aside
            rest = 1.0 - loss - share * along
            return ProfileTrack.of(
                track.name, z * (1.0 + (rest - 1.0) * where(x)) + share * other, track.valid
            )

        return _each(profile, mix_track)

    return mix


def other_road(count: int, interval_m: float) -> FloatArray:
    """Return elevations in m whose slope is white noise."""
    slopes = np.random.default_rng(OTHER_SEED).normal(0.0, 1.0, count)
    return np.cumsum(slopes) * float(np.sqrt(interval_m)) * 1e-3


def raised_cosine(x: FloatArray, length_m: float) -> FloatArray:
    """Return a raised cosine of height 1 and length ``length_m`` around 0."""
    return np.where(np.abs(x) < length_m / 2, np.cos(np.pi * x / length_m) ** 2, 0.0)


def _deviation(z: FloatArray, interval_m: float, inside: BoolArray) -> FloatArray:
    """Return the IRI filter's output less its mean, in m/km."""
    trace = iri_trace(z, interval_m)[inside]
    return np.asarray(trace - trace.mean())


def _elevation(change: Callable[[FloatArray, FloatArray], FloatArray]) -> AddError:
    def add_error(profile: Profile, taken: Taken, label: str) -> Profile:
        x = profile.distance_m
        return _each(
            profile,
            lambda t: ProfileTrack.of(t.name, change(np.array(t.elevation), x), t.valid),
        )

    return add_error


def _each(profile: Profile, change: Callable[[ProfileTrack], ProfileTrack]) -> Profile:
    return replace(profile, tracks=tuple(change(track) for track in profile.tracks))
