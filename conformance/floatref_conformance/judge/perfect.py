"""The profile of a profiler without errors: the filtered truth on the encoder's axis."""

import numpy as np

from floatref.measures import high_pass
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.interface import Taken
from floatref_conformance.proving_ground.scenario import STATIONARY
from floatref_conformance.proving_ground.staging import drive_of


def make_perfect(taken: Taken) -> Profile:
    """Return the truth of ``taken``, filtered (-3 dB at 91.44 m), on the encoder's axis.

    Every point is valid. While the encoder goes back, the vehicle is treated as stationary.
    """
    encoder, travelled = _travel(taken)
    truth = taken.truth
    points = np.arange(int((encoder[-1] - encoder[0]) / truth.interval_m + 1e-9) + 1)
    places = np.interp(encoder[0] + truth.interval_m * points, encoder, travelled)
    tracks = tuple(
        ProfileTrack.of(
            t.name,
            np.interp(places, truth.distance_m, high_pass(t.elevation, truth.interval_m)),
        )
        for t in truth.tracks
    )
    return Profile(truth.interval_m, tracks, float(encoder[0]), "perfect")


def _travel(taken: Taken) -> tuple[FloatArray, FloatArray]:
    """Return the encoder's readings and the true distance at the first of each, both in m."""
    channel = taken.recording.channel("distance")
    seen = np.isfinite(channel.values)
    # A reading is used from its first sample on: a silent encoder repeats its last one.
    encoder, first = np.unique(np.maximum.accumulate(channel.values[seen]), return_index=True)
    if taken.scenario.manoeuvre in STATIONARY:
        return encoder, encoder
    return encoder, drive_of(taken.scenario).motion(channel.times_s[seen][first]).distance
