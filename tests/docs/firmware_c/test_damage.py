"""The firmware in C finds what is damaged, repairs or flags it, and leaves the rest alone."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.files import write_recording
from floatref.measures import iri_trace
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.faults.fault_numbers import NUMBERS
from floatref_conformance.checks.faults.faulty_drives import ROLLING
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS

pytestmark = pytest.mark.slow

STOP = {"manoeuvre": "stop", "length_m": 300.0, "event_at_m": 150.0, "speed_kmh": 50.0}
FAULTS = [name for name in SENSOR_FAULTS if not name.startswith(("gnss", "imu", "response"))]
REPAIRED = (ROLLING, "encoder-counts-back")
AT_M = 140.0
CASES = [(name, n) for name in FAULTS for n in range(len(NUMBERS[name]))]


@pytest.fixture(scope="module")
def whole(simulated):
    """Return recordings of two wheel paths, at constant speed and with a stop."""
    return {False: simulated(), True: simulated(**STOP)}


@pytest.fixture(scope="module")
def sound(start, whole, tmp_path_factory):
    folder = tmp_path_factory.mktemp("sound")
    return {key: start().profile_of(r, folder / str(key)) for key, r in whole.items()}


@pytest.mark.parametrize(("fault", "n"), CASES)
def test_damage_is_repaired_or_flagged_and_the_road_far_before_it_is_as_it_was(
    start, whole, sound, fault, n, tmp_path
):
    recording, right = whole[fault == ROLLING], sound[fault == ROLLING]
    hurt = SENSOR_FAULTS[fault](recording, {"at_m": AT_M, **NUMBERS[fault][n]}).recording
    found = start().profile_of(hurt, tmp_path / "run")
    before, place = (round(x / found.interval_m) for x in (80.0, AT_M))
    for mine, theirs in zip(found.tracks, right.tracks, strict=True):
        trusted = mine.valid[:before] & theirs.valid[:before]
        traces = [iri_trace(t.elevation, found.interval_m)[:before] for t in (mine, theirs)]
        np.testing.assert_allclose((traces[0] - traces[1])[trusted], 0.0, atol=0.05)
        count = min(mine.valid.size, theirs.valid.size)
        if fault in REPAIRED:
            assert np.count_nonzero(theirs.valid[:count] & ~mine.valid[:count]) <= 2
            difference = mine.elevation[:count] - theirs.elevation[:count]
            np.testing.assert_allclose(difference, 0.0, atol=3e-4)
        assert theirs.valid[place : place + 2].all() or fault == ROLLING
    flagged = not all(t.valid[place : place + 2].all() for t in found.tracks)
    assert flagged or fault in REPAIRED


def with_values(recording, name, change, clock=None):
    """Return ``recording`` with the samples of channels ``name`` as ``change`` makes them."""
    channels = tuple(
        Channel.of(name, change(np.array(c.values)), clock or c.clock, c.id.track)
        if c.id.name == name
        else c
        for c in recording.channels
    )
    return Recording(channels, recording.setup)


def test_nothing_is_damaged_in_coarse_and_slow_sensors(start, whole, sound, tmp_path):
    coarse = with_values(
        whole[True], "height", lambda x: np.round(x[::40], 3), UniformClock.of(100)
    )
    coarse = with_values(coarse, "distance", lambda x: np.floor(x / 0.05) * 0.05)
    coarse = with_values(coarse, "vertical_specific_force", lambda x: np.round(x, 2))
    found = start().profile_of(coarse, tmp_path / "run")
    for mine, theirs in zip(found.tracks, sound[True].tracks, strict=True):
        count = min(mine.valid.size, theirs.valid.size)
        changed = np.count_nonzero(mine.valid[:count] != theirs.valid[:count])
        assert changed * found.interval_m < 20.0


@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_holds_steps_and_holes_anywhere_in_the_encoder_give_a_whole_profile(
    start, whole, tmp_path_factory, data
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
    found = start().profile_of(hurt, folder / "run")
    travelled_m = np.nanmax(x) - x[0]
    for track in found.tracks:
        assert np.isfinite(track.elevation).all()
        assert abs(track.elevation.size * found.interval_m - travelled_m) < 0.01


def test_half_the_time_without_a_sample_is_refused(start, whole, tmp_path):
    times = np.arange(20000) / 4000
    clock = StampedClock.of(times + np.where(np.arange(20000) < 9000, 0.0, 6.0))
    holed = with_values(whole[False], "vertical_specific_force", lambda x: x[:20000], clock)
    write_recording(holed, tmp_path / "run")
    answer, _ = start().run(tmp_path / "run")
    assert "vertical_specific_force: half of the time is without a sample" in answer["error"]
