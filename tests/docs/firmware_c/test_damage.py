"""The firmware in C finds what is damaged, and does with it what the pipeline does."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.files import write_recording
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.injured_drives import NUMBERS, ROLLING
from floatref_conformance.checks.injuries import INJURIES

STOP = {"manoeuvre": "stop", "length_m": 300.0, "event_at_m": 150.0, "speed_kmh": 50.0}
FAULTS = [name for name in INJURIES if not name.startswith("gnss")]
CASES = [(name, n) for name in FAULTS for n in range(len(NUMBERS[name]))]


@pytest.fixture(scope="module")
def whole(simulated):
    """Return recordings of two wheel paths, at constant speed and with a stop."""
    return {False: simulated(), True: simulated(**STOP)}


@pytest.mark.parametrize(("fault", "n"), CASES)
def test_a_damaged_recording_is_taken_as_the_pipeline_takes_it(
    start, whole, fault, n, expected, assert_same, tmp_path
):
    recording = whole[fault == ROLLING]
    hurt = INJURIES[fault](recording, {"at_m": 140.0, **NUMBERS[fault][n]}).recording
    wanted = expected(hurt)
    assert_same(start().profile_of(hurt, tmp_path / "run"), wanted)
    assert differs(wanted, expected(recording)) == (fault != ROLLING)


def differs(one, other):
    return any(
        not np.array_equal(a.valid, b.valid) or not np.array_equal(a.elevation, b.elevation)
        for a, b in zip(one.tracks, other.tracks, strict=True)
    )


def with_values(recording, name, change, clock=None):
    """Return ``recording`` with the samples of channels ``name`` as ``change`` makes them."""
    channels = tuple(
        Channel.of(name, change(np.array(c.values)), clock or c.clock, c.id.track)
        if c.id.name == name
        else c
        for c in recording.channels
    )
    return Recording(channels, recording.setup)


def test_nothing_is_damaged_in_coarse_and_slow_sensors(
    start, whole, expected, assert_same, tmp_path
):
    coarse = with_values(
        whole[True], "height", lambda x: np.round(x[::40], 3), UniformClock.of(100)
    )
    coarse = with_values(coarse, "distance", lambda x: np.floor(x / 0.05) * 0.05)
    coarse = with_values(coarse, "vertical_specific_force", lambda x: np.round(x, 2))
    assert_same(start().profile_of(coarse, tmp_path / "run"), expected(coarse))


@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_holds_steps_and_holes_anywhere_in_the_encoder(
    start, whole, expected, assert_same, tmp_path_factory, data
):
    x = np.array(whole[True].channel("distance").values)
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(500, x.size - 9000))
        behind = at + data.draw(st.sampled_from([1, 30, 90, 250, 2500, 8500]))
        kind = data.draw(st.sampled_from(["hold", "lose", "miss", "leap", "back"]))
        if kind == "miss":
            x[at:behind] = np.nan
        elif kind == "back":
            x[at:behind] -= 0.01
        elif kind == "leap":
            x[at:] += 0.3
        else:
            x[behind:] -= np.nan_to_num(x[behind] - x[at]) if kind == "lose" else 0.0
            x[at:behind] = x[at]
    hurt = with_values(whole[True], "distance", lambda _: x)
    if data.draw(st.booleans()):
        clock = StampedClock.of(np.arange(x.size) / 4000)
        hurt = with_values(hurt, "distance", lambda x: x, clock)
    folder = tmp_path_factory.mktemp("run")
    assert_same(start().profile_of(hurt, folder / "run"), expected(hurt))


def test_half_the_time_without_a_sample_is_refused(start, whole, tmp_path):
    times = np.arange(20000) / 4000
    clock = StampedClock.of(times + np.where(np.arange(20000) < 9000, 0.0, 6.0))
    holed = with_values(whole[False], "vertical_specific_force", lambda x: x[:20000], clock)
    write_recording(holed, tmp_path / "run")
    answer, _ = start().run(tmp_path / "run")
    assert "vertical_specific_force: half of the time is without a sample" in answer["error"]
