"""Mutations of the delivered profile: shape, place, flags, or an older result."""

from dataclasses import replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.mutants import profiles as p
from floatref_conformance.mutants.drive_conditions import middle_m
from floatref_conformance.mutants.mutation import Mutation, all_but

BEGINNING = 2000
"""Number of first samples by which two recordings are compared."""


class Repeated:
    """Delivers the previous profile if a recording begins like the previous one.

    The profile is moved to the distances of the new recording: points that the vehicle passes at
    the same time have the same elevation.
    """

    def __init__(self) -> None:
        """Begin with no recording."""
        self.kept: tuple[Profile, Recording] | None = None

    def __call__(self, profile: Profile, recording: Recording) -> Profile:
        """Return the stored profile if ``recording`` begins alike, else store ``profile``."""
        if self.kept is not None and _begin_alike(self.kept[1], recording):
            return _move_over(*self.kept, profile, recording)
        self.kept = profile, recording
        return profile


def _begin_alike(one: Recording, other: Recording) -> bool:
    return len(one.channels) == len(other.channels) and all(
        a.id == b.id and np.array_equal(a.values[:BEGINNING], b.values[:BEGINNING], equal_nan=True)
        for a, b in zip(one.channels, other.channels, strict=True)
    )


def _move_over(kept: Profile, before: Recording, profile: Profile, recording: Recording) -> Profile:
    """Return ``kept``, made of ``before``, on the points of ``profile``, made of ``recording``."""
    times, travelled = _travel(recording)
    travelled, first = np.unique(travelled, return_index=True)
    passed_s = np.interp(profile.distance_m, travelled, times[first])
    places_m = np.interp(passed_s, *_travel(before))

    def move(track: ProfileTrack) -> ProfileTrack:
        z = np.interp(places_m, kept.distance_m, track.elevation)
        valid = np.interp(places_m, kept.distance_m, track.valid.astype(np.float64))
        return ProfileTrack.of(track.name, z, valid == 1.0)

    return replace(profile, tracks=tuple(move(track) for track in kept.tracks))


def _travel(recording: Recording) -> tuple[FloatArray, FloatArray]:
    """Return times from the beginning in s, and the largest encoder reading so far in m."""
    encoder = recording.channel("distance")
    seen = np.isfinite(encoder.values)
    farthest = np.maximum.accumulate(encoder.values[seen])
    return encoder.times_s[seen] - encoder.times_s[0], farthest


IN_RESULTS = (
    Mutation("all-zeros", "delivers a flat profile", all_but("low-speed"), after=p.scale(0.0)),
    Mutation(
        "upside-down",
        "delivers the profile upside down",
        all_but("low-speed", "faults"),
        after=p.scale(-1.0),
    ),
    Mutation("scaled", "delivers 0.8 of the profile", all_but("low-speed"), after=p.scale(0.8)),
    Mutation("in-mm", "delivers mm for m", all_but("low-speed"), after=p.scale(1000.0)),
    Mutation("in-feet", "delivers feet for m", all_but("low-speed"), after=p.scale(1 / 0.3048)),
    Mutation(
        "over-smoothed",
        "averages the profile over 2 m",
        all_but("low-speed"),
        after=p.average(2.0),
    ),
    Mutation(
        "staircase",
        "holds each elevation for 0.5 m",
        all_but("low-speed", "coasting", "throttle", "braking", "stop"),
        after=p.hold_in_steps(0.5),
    ),
    Mutation(
        "coarse", "delivers whole millimetres", ("waveband", "invariance"), after=p.round_to(0.001)
    ),
    Mutation(
        "noisy-where-flat",
        "adds noise of 0.07 m/km to a flat profile",
        ("quiescent",),
        after=p.add_noise_where_flat(0.00008),
    ),
    Mutation(
        "motion-where-flat",
        "lets 1 % of the body's motion into a flat profile",
        ("bounce",),
        after=p.add_motion_where_flat(0.01),
    ),
    Mutation(
        "displaced",
        "delivers every feature 0.3 m late",
        ("quiescent", "bounce", "waveband", "distance"),
        after=p.move(0.3),
    ),
    Mutation(
        "stretched",
        "makes distances 0.3 % too long",
        ("quiescent", "bounce", "waveband", "distance", "invariance"),
        after=p.stretch(0.003),
    ),
    Mutation(
        "backwards",
        "delivers the last point first",
        all_but("low-speed", "faults"),
        after=p.reverse,
    ),
    Mutation(
        "swapped-tracks",
        "delivers left as right, right as left",
        all_but("low-speed", "invariance"),
        after=p.swap_tracks,
    ),
    Mutation(
        "tracks-alike",
        "delivers the mean of all wheel paths in each",
        all_but("low-speed", "invariance"),
        after=p.average_tracks,
    ),
    Mutation("previous-result", "delivers the previous profile", all_but(), after=p.Previous()),
    Mutation(
        "repeated-result",
        "delivers the previous profile if a recording begins like the previous one",
        ("faults",),
        after=Repeated(),
    ),
    Mutation(
        "nan-at-the-end",
        "leaves out the last 120 m",
        all_but("low-speed", "waveband"),
        after=p.drop_end(120.0),
    ),
    Mutation("begins-late", "leaves out the first 5 m", all_but(), after=p.drop_start(5.0)),
    Mutation(
        "vouches-always",
        "marks every point valid",
        ("low-speed", "near-stop", "stop", "faults"),
        after=p.mark_valid,
    ),
    Mutation(
        "vouches-never",
        "marks no point valid",
        (
            "constant-speed",
            "coasting",
            "throttle",
            "braking",
            "near-stop",
            "stop",
            "dead-start",
            "faults",
        ),
        after=p.flag_all,
    ),
    Mutation(
        "middle-flagged",
        "flags 124 m in the middle of every run",
        ("constant-speed", "braking", "near-stop", "stop", "dead-start", "faults"),
        after=p.flag_around(middle_m, 124.0),
    ),
    Mutation(
        "held-at-the-stop",
        "holds the elevation 20 m to either side of the slowest point, and marks it valid",
        all_but("dead-start", "distance"),
        after=p.hold_at_slowest(20.0),
    ),
)
"""Mutations of all delivered profiles."""
