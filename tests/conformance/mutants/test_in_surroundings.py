"""What a slope under the vehicle, or a laser ahead of its accelerometer, adds if it is ignored."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import high_pass
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup, TrackSetup
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.mutants.in_fusion import Attitude, add_tilt_error
from floatref_conformance.mutants.in_surroundings import IN_SURROUNDINGS
from floatref_conformance.own_plugin import make_checks

GRAVITY, OFFSET, SLIP = IN_SURROUNDINGS
AUGMENTED = Description("perfect", "1", "temporal", ("imu", "gnss"))
CHECKS = {check.id: check for check in make_checks(find_edition("2026.2"))}
INTERVAL, SPEED, RATE = 0.05, 20.0, 1000.0
TIMES = np.arange(20000) / RATE
X = INTERVAL * np.arange(round(SPEED * TIMES[-1] / INTERVAL))
BRAKE = np.where((TIMES > 8.0) & (TIMES < 11.0), -2.0, 0.0)


def record(pitch, ahead_m=0.0, forward=BRAKE):
    """Return a recording whose receiver tells ``pitch``, at a speed that stays for simplicity."""
    clock, fixes = UniformClock.of(RATE), UniformClock.of(100.0)
    values = {
        "distance": (SPEED * TIMES, clock, None),
        "height": (0.3 + 1e-9 * np.sin(TIMES), clock, "left"),
        "vertical_specific_force": (np.full(TIMES.size, STANDARD_GRAVITY), clock, "left"),
        "longitudinal_specific_force": (forward, clock, "left"),
        "lateral_specific_force": (np.zeros(TIMES.size), clock, "left"),
        "gnss_pitch": (pitch(TIMES[::10]), fixes, None),
        "gnss_roll": (np.zeros(2000), fixes, None),
        "gnss_quality": (np.full(2000, 4.0), fixes, None),
    }
    channels = tuple(Channel.of(name, v, c, t) for name, (v, c, t) in values.items())
    setup = Setup(tracks={"left": TrackSetup(laser_offset_m=(ahead_m, 0.0, 0.0))})
    return Recording(channels, setup)


def profile(elevation):
    return Profile(INTERVAL, (ProfileTrack.of("left", elevation),))


def added(mutation, elevation, recording):
    changed = mutation.after(profile(elevation), recording).track("left").elevation
    return changed - elevation


def nod(times):
    return 0.01 * np.sin(2 * np.pi * SPEED * times / 25.0)


def test_on_a_level_road_gravity_may_be_left_out():
    assert np.array_equal(added(GRAVITY, np.zeros(X.size), record(nod)), np.zeros(X.size))


@settings(deadline=None, max_examples=5)
@given(slope=st.floats(0.01, 0.08).flatmap(lambda s: st.sampled_from([s, -s])))
def test_a_body_that_lies_along_a_slope_seems_level_where_gravity_is_left_out(slope):
    recording = record(lambda times: np.full(times.size, -slope))
    ramp = slope * (X - X[-1] / 2)
    level = add_tilt_error(lambda true: Attitude(0.0 * true.pitch, true.roll))
    expected = level(profile(ramp), recording).track("left").elevation - ramp
    inside = (X > 120.0) & (X[-1] - 120.0 > X)
    found = added(GRAVITY, ramp, recording)
    assert np.abs(expected[inside]).max() > 0.2 * abs(slope)
    assert found[inside] == pytest.approx(expected[inside], abs=0.02 * np.abs(expected).max())


def test_at_an_offset_of_0_it_may_be_ignored():
    z = 0.001 * np.sin(X)
    assert np.array_equal(added(OFFSET, z, record(nod)), np.zeros(X.size))


@settings(deadline=None, max_examples=5)
@given(ahead_m=st.floats(-0.3, 0.3))
def test_an_ignored_offset_raises_the_road_by_its_length_times_the_pitch(ahead_m):
    # Waves of 25 m pass the filter; nine readings of the pitch, 1.6 m, are averaged.
    found = added(OFFSET, np.zeros(X.size), record(nod, ahead_m))
    expected = high_pass(ahead_m * nod(X / SPEED), INTERVAL)
    inside = (X > 120.0) & (X[-1] - 120.0 > X)
    assert found[inside] == pytest.approx(expected[inside], abs=0.05 * 0.01 * abs(ahead_m))


class Bench:
    """Delivers the profile without errors along the encoder, with a mutation."""

    def __init__(self, mutation):
        self.mutation = mutation

    def simulate(self, scenario):
        return make_taken(restrict_channels(AUGMENTED, scenario))

    def run(self, taken, label=""):
        return self.mutation.after(make_perfect(taken), taken.recording)


def test_mutants_name_checks_and_a_class():
    assert {m.name: (m.fails, m.claims) for m in IN_SURROUNDINGS} == {
        "gravity-left-out": (("stop",), DeviceClass.NOMINAL),
        "offset-ignored": (("braking",), DeviceClass.NOMINAL),
        "slip-believed": (("throttle", "braking", "near-stop", "stop"), DeviceClass.ADEQUATE),
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mutation", "id_"),
    [(mutation, id_) for mutation in IN_SURROUNDINGS for id_ in mutation.fails],
    ids=lambda value: getattr(value, "name", value),
)
def test_each_fails_what_it_names_though_all_else_is_right(mutation, id_):
    check = CHECKS[id_]
    cases = check.cases(0, Effort.QUICK)
    measured = [m for case in cases for m in check.judge(case, Bench(mutation))]
    assert not all(m.within(mutation.claims) for m in measured)
