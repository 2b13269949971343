"""What spoils a profile after it was made."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.mutants.drive_conditions import Drive
from floatref_conformance.mutants.mutation import After

Elevation = Callable[[FloatArray, Profile], FloatArray]
NOISE_SEED, NOISE_STEP_M = 20, 0.5
FLAT_M = 0.001
"""A profile whose standard deviation is less shows no road."""


def change_elevation(change: Elevation) -> After:
    """Return what puts ``change`` of it in place of every elevation; flags stay."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        return _each(
            profile,
            lambda t: ProfileTrack.of(t.name, change(np.array(t.elevation), profile), t.valid),
        )

    return spoil


def scale(gain: float) -> After:
    """Return what multiplies every elevation by ``gain``."""
    return change_elevation(lambda z, _: gain * z)


def move(length_m: float) -> After:
    """Return what lets every feature lie ``length_m`` farther along."""
    return change_elevation(lambda z, p: _sample_at(z, p, p.distance_m - length_m))


def stretch(share: float) -> After:
    """Return what makes distances longer by ``share`` of them."""
    return change_elevation(
        lambda z, p: _sample_at(z, p, p.start_m + (p.distance_m - p.start_m) / (1 + share))
    )


def average(length_m: float) -> After:
    """Return what takes the mean over ``length_m`` around every point."""

    def smooth(z: FloatArray, profile: Profile) -> FloatArray:
        half = round(length_m / profile.interval_m / 2)
        total = np.concatenate(([0.0], np.cumsum(np.nan_to_num(z))))
        first = np.maximum(np.arange(z.size) - half, 0)
        last = np.minimum(np.arange(z.size) + half + 1, z.size)
        return np.where(np.isnan(z), z, (total[last] - total[first]) / (last - first))

    return change_elevation(smooth)


def hold_in_steps(length_m: float) -> After:
    """Return what holds an elevation until ``length_m`` are over."""

    def hold(z: FloatArray, profile: Profile) -> FloatArray:
        count = round(length_m / profile.interval_m)
        return z[np.arange(z.size) // count * count]

    return change_elevation(hold)


def round_to(step_m: float) -> After:
    """Return what delivers whole multiples of ``step_m``."""
    return change_elevation(lambda z, _: step_m * np.round(z / step_m))


def add_noise_where_flat(slope: float) -> After:
    """Return what adds noise to a flat profile: a polygon whose sides climb by ``slope``."""

    def add(z: FloatArray, profile: Profile) -> FloatArray:
        if not _is_flat(z):
            return z
        x = profile.distance_m - profile.start_m
        corners = np.arange(0.0, x[-1] + NOISE_STEP_M, NOISE_STEP_M)
        draw = np.random.default_rng(NOISE_SEED)
        return z + np.interp(x, corners, draw.normal(0.0, NOISE_STEP_M * slope, corners.size))

    return change_elevation(add)


def add_motion_where_flat(share: float) -> After:
    """Return what adds ``share`` of the body's motion, by the laser, to a flat profile."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        encoder = recording.channel("distance")

        def add(track: ProfileTrack) -> ProfileTrack:
            z = np.array(track.elevation)
            if not _is_flat(z):
                return track
            laser = recording.channel("height", track.name)
            told = np.interp(laser.times_s, encoder.times_s, encoder.values)
            motion = np.interp(profile.distance_m, told, laser.values - laser.values[0])
            return ProfileTrack.of(track.name, z + share * motion, track.valid)

        return _each(profile, add)

    return spoil


def drop_end(length_m: float) -> After:
    """Return what leaves out the elevations of the last ``length_m``."""
    return change_elevation(
        lambda z, p: np.where(p.distance_m > p.start_m + p.length_m - length_m, np.nan, z)
    )


def reverse(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with its last point first."""
    return _each(profile, lambda t: ProfileTrack.of(t.name, t.elevation[::-1], t.valid[::-1]))


def swap_tracks(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with its elevations under the names of other wheel paths."""
    others = (*profile.tracks[1:], profile.tracks[0])
    pairs = zip(profile.tracks, others, strict=True)
    tracks = tuple(ProfileTrack.of(t.name, other.elevation, other.valid) for t, other in pairs)
    return replace(profile, tracks=tracks)


def average_tracks(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with the mean of all wheel paths under every name."""
    mean = np.mean([t.elevation for t in profile.tracks], axis=0)
    return _each(profile, lambda t: ProfileTrack.of(t.name, mean, t.valid))


def drop_start(length_m: float) -> After:
    """Return what leaves out the first points, up to ``length_m``."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        count = round(length_m / profile.interval_m)
        later = replace(profile, start_m=profile.start_m + count * profile.interval_m)
        return _each(later, lambda t: ProfileTrack.of(t.name, t.elevation[count:], t.valid[count:]))

    return spoil


def mark_valid(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with every point valid that has an elevation."""
    return _each(profile, lambda t: ProfileTrack.of(t.name, t.elevation))


def flag_all(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with no point valid."""
    return _each(profile, lambda t: ProfileTrack.of(t.name, t.elevation, np.zeros_like(t.valid)))


def flag_around(where: Callable[[Drive], float], length_m: float) -> After:
    """Return what flags ``length_m`` around the place that ``where`` finds, in m."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        near = np.abs(profile.distance_m - where(Drive.of(recording))) < length_m / 2
        return _each(profile, lambda t: ProfileTrack.of(t.name, t.elevation, t.valid & ~near))

    return spoil


def hold_at_slowest(reach_m: float) -> After:
    """Return what holds one elevation up to ``reach_m`` from where the vehicle is slowest."""
    return _replace_at_slowest(reach_m, lambda z, near: np.full(near.size, z[near[0]]))


def straighten_at_slowest(reach_m: float) -> After:
    """Return what draws a straight line up to ``reach_m`` from where the vehicle is slowest."""
    return _replace_at_slowest(
        reach_m, lambda z, near: np.linspace(z[near[0]], z[near[-1]], near.size)
    )


def _replace_at_slowest(
    reach_m: float, make: Callable[[FloatArray, NDArray[np.intp]], FloatArray]
) -> After:
    """Return what puts ``make`` of elevations and near points in their place, all valid."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        away = np.abs(profile.distance_m - Drive.of(recording).slowest_m)
        near = np.flatnonzero(away < reach_m)

        def change(track: ProfileTrack) -> ProfileTrack:
            z = np.array(track.elevation)
            z[near] = make(z, near)
            return ProfileTrack.of(track.name, z)

        return _each(profile, change)

    return spoil


def lose_at_slowest(length_m: float) -> After:
    """Return what loses ``length_m`` of road where the vehicle is slowest."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        x = profile.distance_m
        places = x + np.where(x > Drive.of(recording).slowest_m, length_m, 0.0)
        return change_elevation(lambda z, p: _sample_at(z, p, places))(profile, recording)

    return spoil


def chain(first: After, second: After) -> After:
    """Return ``second`` after ``first``."""
    return lambda profile, recording: second(first(profile, recording), recording)


class Previous:
    """Delivers the profile before; the first is itself."""

    def __init__(self) -> None:
        """Begin with no profile."""
        self.last: Profile | None = None

    def __call__(self, profile: Profile, recording: Recording) -> Profile:
        """Return what was last given, and keep ``profile``."""
        delivered, self.last = self.last or profile, profile
        return delivered


def _is_flat(z: FloatArray) -> bool:
    return float(np.nanstd(z)) < FLAT_M


def _sample_at(z: FloatArray, profile: Profile, places_m: FloatArray) -> FloatArray:
    seen = np.isfinite(z)
    return np.interp(places_m, profile.distance_m[seen], z[seen])


def _each(profile: Profile, change: Callable[[ProfileTrack], ProfileTrack]) -> Profile:
    return replace(profile, tracks=tuple(change(track) for track in profile.tracks))
