"""A bench with one recording, and recordings for it."""

from dataclasses import replace

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.interface import Taken
from floatref_conformance.proving_ground.simulate import simulate


class OneRecording:
    """Hands out one recording, and what ``device`` makes of it."""

    def __init__(self, taken, device):
        self.taken, self.device = taken, device

    def simulate(self, scenario):
        return self.taken

    def run(self, taken, label=""):
        return self.device(taken)


def taken_of(scenario):
    made = simulate(replace(scenario, imu=False, gnss=False))
    return Taken(made.recording, made.truth, scenario)


def follow_true_distance(taken):
    """Return the truth of ``taken``, filtered as a profile is, along the true distance."""
    truth = taken.truth
    tracks = tuple(
        ProfileTrack.of(t.name, high_pass(t.elevation, truth.interval_m)) for t in truth.tracks
    )
    return Profile(truth.interval_m, tracks, truth.start_m)
