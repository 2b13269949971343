"""Mutations of a finished profile."""

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
"""A profile with a smaller standard deviation, in m, is flat."""


def change_elevation(change: Elevation) -> After:
    """Return a mutation that applies ``change`` to every elevation; flags do not change."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        return change_each(
            profile,
            lambda t: ProfileTrack.of(t.name, change(np.array(t.elevation), profile), t.valid),
        )

    return mutate


def scale(gain: float) -> After:
    """Return a mutation that multiplies every elevation by ``gain``."""
    return change_elevation(lambda z, _: gain * z)


def move(length_m: float) -> After:
    """Return a mutation that moves every feature forward by ``length_m``."""
    return change_elevation(lambda z, p: _sample_at(z, p, p.distance_m - length_m))


def stretch(share: float) -> After:
    """Return a mutation that lengthens distances by ``share``."""
    return change_elevation(
        lambda z, p: _sample_at(z, p, p.start_m + (p.distance_m - p.start_m) / (1 + share))
    )


def average(length_m: float) -> After:
    """Return a mutation that averages over ``length_m`` around every point."""

    def smooth(z: FloatArray, profile: Profile) -> FloatArray:
        half = round(length_m / profile.interval_m / 2)
        total = np.concatenate(([0.0], np.cumsum(np.nan_to_num(z))))
        first = np.maximum(np.arange(z.size) - half, 0)
        last = np.minimum(np.arange(z.size) + half + 1, z.size)
        return np.where(np.isnan(z), z, (total[last] - total[first]) / (last - first))

    return change_elevation(smooth)


def hold_in_steps(length_m: float) -> After:
    """Return a mutation that holds an elevation for ``length_m``."""

    def hold(z: FloatArray, profile: Profile) -> FloatArray:
        count = round(length_m / profile.interval_m)
        return z[np.arange(z.size) // count * count]

    return change_elevation(hold)


def round_to(step_m: float) -> After:
    """Return a mutation that rounds to multiples of ``step_m``."""
    return change_elevation(lambda z, _: step_m * np.round(z / step_m))


def add_noise_where_flat(slope: float) -> After:
    """Return a mutation that adds noise to a flat profile: a polygon with sides of ``slope``."""

    def add(z: FloatArray, profile: Profile) -> FloatArray:
        if not _is_flat(z):
            return z
        x = profile.distance_m - profile.start_m
        corners = np.arange(0.0, x[-1] + NOISE_STEP_M, NOISE_STEP_M)
        draw = np.random.default_rng(NOISE_SEED)
        return z + np.interp(x, corners, draw.normal(0.0, NOISE_STEP_M * slope, corners.size))

    return change_elevation(add)


def add_motion_where_flat(share: float) -> After:
    """Return a mutation that adds ``share`` of the laser's height to a flat profile."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        encoder = recording.channel("distance")

        def add(track: ProfileTrack) -> ProfileTrack:
            z = np.array(track.elevation)
            if not _is_flat(z):
                return track
            laser = recording.channel("height", track.name)
            travelled = np.interp(laser.times_s, encoder.times_s, encoder.values)
            motion = np.interp(profile.distance_m, travelled, laser.values - laser.values[0])
            return ProfileTrack.of(track.name, z + share * motion, track.valid)

        return change_each(profile, add)

    return mutate


def drop_end(length_m: float) -> After:
    """Return a mutation that removes the elevations of the last ``length_m``."""
    return change_elevation(
        lambda z, p: np.where(p.distance_m > p.start_m + p.length_m - length_m, np.nan, z)
    )


def reverse(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with its last point first."""
    return change_each(profile, lambda t: ProfileTrack.of(t.name, t.elevation[::-1], t.valid[::-1]))


def swap_tracks(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with the elevations of other wheel paths under each name."""
    others = (*profile.tracks[1:], profile.tracks[0])
    pairs = zip(profile.tracks, others, strict=True)
    tracks = tuple(ProfileTrack.of(t.name, other.elevation, other.valid) for t, other in pairs)
    return replace(profile, tracks=tracks)


def average_tracks(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with the mean of all wheel paths under every name."""
    mean = np.mean([t.elevation for t in profile.tracks], axis=0)
    return change_each(profile, lambda t: ProfileTrack.of(t.name, mean, t.valid))


def drop_start(length_m: float) -> After:
    """Return a mutation that removes the points of the first ``length_m``."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        count = round(length_m / profile.interval_m)
        later = replace(profile, start_m=profile.start_m + count * profile.interval_m)
        return change_each(
            later, lambda t: ProfileTrack.of(t.name, t.elevation[count:], t.valid[count:])
        )

    return mutate


def mark_valid(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with all points valid that have an elevation."""
    return change_each(profile, lambda t: ProfileTrack.of(t.name, t.elevation))


def flag_all(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with no point valid."""
    return change_each(
        profile, lambda t: ProfileTrack.of(t.name, t.elevation, np.zeros_like(t.valid))
    )


def flag_around(where: Callable[[Drive], float], length_m: float) -> After:
    """Return a mutation that flags ``length_m`` around the place that ``where`` returns, in m."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        near = np.abs(profile.distance_m - where(Drive.of(recording))) < length_m / 2
        return change_each(profile, lambda t: ProfileTrack.of(t.name, t.elevation, t.valid & ~near))

    return mutate


def hold_at_slowest(reach_m: float) -> After:
    """Return a mutation with constant elevation within ``reach_m`` of the slowest place."""
    return _replace_at_slowest(reach_m, lambda z, near: np.full(near.size, z[near[0]]))


def straighten_at_slowest(reach_m: float) -> After:
    """Return a mutation with a straight line within ``reach_m`` of the slowest place."""
    return _replace_at_slowest(
        reach_m, lambda z, near: np.linspace(z[near[0]], z[near[-1]], near.size)
    )


def _replace_at_slowest(
    reach_m: float, make: Callable[[FloatArray, NDArray[np.intp]], FloatArray]
) -> After:
    """Return a mutation that replaces elevations by those of ``make`` and marks all valid."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        away = np.abs(profile.distance_m - Drive.of(recording).slowest_m)
        near = np.flatnonzero(away < reach_m)

        def change(track: ProfileTrack) -> ProfileTrack:
            z = np.array(track.elevation)
            z[near] = make(z, near)
            return ProfileTrack.of(track.name, z)

        return change_each(profile, change)

    return mutate


def lose_at_slowest(length_m: float) -> After:
    """Return a mutation that loses ``length_m`` of road where the vehicle is slowest."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        x = profile.distance_m
        places = x + np.where(x > Drive.of(recording).slowest_m, length_m, 0.0)
        return change_elevation(lambda z, p: _sample_at(z, p, places))(profile, recording)

    return mutate


def chain(first: After, second: After) -> After:
    """Return a mutation that applies ``first``, then ``second``."""
    return lambda profile, recording: second(first(profile, recording), recording)


class Previous:
    """Delivers the previous profile; the first time, the profile itself."""

    def __init__(self) -> None:
        """Begin with no profile."""
        self.last: Profile | None = None

    def __call__(self, profile: Profile, recording: Recording) -> Profile:
        """Return the previous profile, and store ``profile``."""
        delivered, self.last = self.last or profile, profile
        return delivered


def _is_flat(z: FloatArray) -> bool:
    return float(np.nanstd(z)) < FLAT_M


def _sample_at(z: FloatArray, profile: Profile, places_m: FloatArray) -> FloatArray:
    seen = np.isfinite(z)
    return np.interp(places_m, profile.distance_m[seen], z[seen])


def change_each(profile: Profile, change: Callable[[ProfileTrack], ProfileTrack]) -> Profile:
    """Return ``profile`` with ``change`` applied to each of its wheel paths."""
    return replace(profile, tracks=tuple(change(track) for track in profile.tracks))
