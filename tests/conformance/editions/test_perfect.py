"""A profile without errors in edition 2026.2: along the true distance, and along the encoder's."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from tests.conformance.checks.benches import follow_true_distance

from floatref.values.profile import ProfileTrack
from floatref_conformance.checks.interface import fit_check
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.own_plugin import make_checks
from floatref_conformance.selftest.grading import NOMINAL

CHECKS = {check.id: check for check in make_checks(find_edition("2026.2"))}
PLACED = (
    "constant-speed",
    "low-speed",
    "coasting",
    "throttle",
    "braking",
    "near-stop",
    "stop",
    "dead-start",
    "waveband",
    "repeatability",
    "distance",
)
"""The checks whose truth is the road; the others compare with a plate or another recording.

Of these, the recordings of `invariance` begin where the profile without errors does not expect it.
"""
SLIP_BELIEVED = ("throttle", "braking", "near-stop", "stop")
"""Where a wheel slips so far that a device of class adequate must know it."""


class Bench:
    """Delivers what ``make`` returns for a recording without inertial unit and receiver."""

    def __init__(self, make):
        self.make = make

    def simulate(self, scenario):
        return make_taken(restrict_channels(NOMINAL, scenario))

    def run(self, taken, label=""):
        return self.make(taken)


def failing(id_, make, device_class):
    """Return how often each quantity fails in the cases of a quick run."""
    check = fit_check(CHECKS[id_], NOMINAL.meets)
    cases = check.cases(0, Effort.QUICK)
    measured = [m for case in cases for m in check.judge(case, Bench(make))]
    return Counter(m.quantity for m in measured if not m.within(device_class))


@pytest.mark.slow
@pytest.mark.parametrize("id_", PLACED)
def test_along_the_true_distance_it_is_of_class_reference(id_):
    for device_class in DeviceClass:
        assert failing(id_, follow_true_distance, device_class) == {}


@pytest.mark.slow
@pytest.mark.parametrize("id_", [id_ for id_ in CHECKS if id_ != "invariance"])
def test_along_the_encoder_it_is_of_class_nominal(id_):
    assert failing(id_, make_perfect, DeviceClass.NOMINAL) == {}


@pytest.mark.slow
@pytest.mark.parametrize("id_", SLIP_BELIEVED)
def test_who_believes_a_slipping_wheel_is_not_of_class_adequate(id_):
    assert failing(id_, make_perfect, DeviceClass.ADEQUATE).keys() == {"correlation loss"}


def test_every_check_is_named():
    assert {*PLACED, "quiescent", "bounce", "invariance", "faults"} == set(CHECKS)


def give_up_below_16_km_per_h(taken):
    """Return the profile without errors, without elevation where the encoder says 16 km/h."""
    sound, encoder = make_perfect(taken), taken.recording.channel("distance")
    speed = np.gradient(np.interp(encoder.times_s, *every_tenth(encoder)), encoder.times_s)
    there = np.interp(sound.distance_m, encoder.values, speed)
    slow = there < 16 / 3.6
    tracks = tuple(
        ProfileTrack.of(t.name, np.where(slow, np.nan, t.elevation), ~slow) for t in sound.tracks
    )
    return replace(sound, tracks=tracks)


def every_tenth(encoder):
    """Return times and values at tenths of a second, between which the speed hardly changes."""
    times = np.arange(encoder.times_s[0], encoder.times_s[-1] + 0.1, 0.1)
    return times, np.interp(times, encoder.times_s, encoder.values)


def brakes_to_15_km_per_h(edition):
    check = {check.id: check for check in make_checks(find_edition(edition))}["braking"]
    cases = [c for c in check.cases(0, Effort.QUICK) if c.scenario.event_speed_kmh == 15.0]
    assert len(cases) == 3
    return [(check, case) for case in cases]


@pytest.mark.slow
def test_an_honest_device_may_give_up_a_brake_to_15_km_per_h_that_rolls_on():
    for check, case in brakes_to_15_km_per_h("2026.2"):
        measured = check.judge(case, Bench(give_up_below_16_km_per_h))
        assert all(m.within(DeviceClass.NOMINAL) for m in measured)
        assert not all(m.within(DeviceClass.ADEQUATE) for m in measured)
    for check, case in brakes_to_15_km_per_h("2026.1"):
        with pytest.raises(DeviceError, match="without elevation"):
            check.judge(case, Bench(give_up_below_16_km_per_h))
