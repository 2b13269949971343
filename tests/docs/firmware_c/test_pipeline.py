"""The firmware in C is the pipeline that it stands for, sample for sample."""

import numpy as np
import pytest

from floatref.files import read_profile, write_recording
from floatref.measures import iri
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.devices.executable import make

pytestmark = pytest.mark.slow

STOP = {"manoeuvre": "stop", "length_m": 450.0, "event_at_m": 230.0, "deceleration_g": 0.3}


@pytest.fixture(scope="module")
def drives(simulated):
    """Return the recordings that the tests share."""
    return {
        "constant": simulated(tracks=("main",)),
        "stop": simulated(**STOP, tracks=("main",)),
        "stop of two wheel paths at 16 kHz": simulated(**STOP, rate_hz=16000.0),
        "stop at 1 kHz": simulated(**STOP, rate_hz=1000.0),
        "three wheel paths": with_a_third(simulated(length_m=150.0)),
    }


def with_a_third(recording):
    """Return ``recording`` with the left wheel path, back to front, in the middle, too."""
    left = [c for c in recording.channels if c.id.track == "left"]
    middle = [Channel.of(c.id.name, np.array(c.values)[::-1], c.clock, "middle") for c in left]
    return Recording((*recording.channels, *middle), recording.setup)


def changed(recording, change):
    """Return ``recording`` with each channel's samples and clock as ``change`` says."""
    channels = []
    for c in recording.channels:
        values, clock = change(c.id.name, np.array(c.values), c.clock)
        channels.append(Channel.of(c.id.name, values, clock, c.id.track))
    return Recording(tuple(channels), recording.setup)


def with_gaps(name, x, clock):
    if name == "height":
        x[::997] = x[30000:30150] = np.nan
    elif name == "distance":
        x[50000:50020] = x[10000:12500] = np.nan
    else:
        x[:5] = x[20000:20030] = x[40000:40100] = x[-3:] = np.nan
    return x, clock


def on_other_clocks(name, x, clock):
    if name == "height":
        return x[::7], UniformClock.of(4000 / 7)
    return (x[3::40], UniformClock.of(100, 3 / 4000)) if name == "distance" else (x, clock)


def on_time_stamps(name, x, clock):
    t = clock.times(x.size) + 1234.5
    if name == "height":
        kept = np.flatnonzero((np.arange(x.size) % 3 > 0) & (abs(t - 1240.0) > 0.1))
    elif name == "distance":
        kept = np.flatnonzero(np.diff(x, prepend=-1.0) > 0)[::5]
    else:
        t, kept = np.round(t, 6), np.arange(x.size)
    return x[kept], StampedClock.of(t[kept])


def all_on_time_stamps(name, x, clock):
    return x, StampedClock.of(clock.times(x.size))


def two_seconds(name, x, clock):
    return x[:8000], clock


def starting_late(name, x, clock):
    return (x[100:], UniformClock.of(4000, 0.025)) if name == "height" else (x, clock)


@pytest.mark.parametrize(
    "drive",
    [
        *("constant", "stop", "stop of two wheel paths at 16 kHz"),
        *("stop at 1 kHz", "three wheel paths"),
    ],
)
def test_a_profile_is_that_of_the_pipeline(start, drives, drive, expected, assert_same, tmp_path):
    found = start().profile_of(drives[drive], tmp_path / "run")
    assert_same(found, expected(drives[drive]))


def test_the_judge_gets_that_profile_too(build, drives, expected, assert_same, tmp_path):
    write_recording(drives["stop"], tmp_path / "run")
    device = make(str(build("firmware")))
    assert device.describe()["capabilities"] == []
    device.run(tmp_path / "run" / "recording.json", tmp_path / "profile")
    device.close()
    assert_same(read_profile(tmp_path / "profile"), expected(drives["stop"]))


@pytest.mark.parametrize(
    "change",
    [
        *(with_gaps, on_other_clocks, on_time_stamps, all_on_time_stamps),
        *(starting_late, two_seconds),
    ],
)
def test_gaps_and_clocks_are_taken_as_the_pipeline_takes_them(
    start, drives, change, expected, assert_same, tmp_path
):
    recording = changed(drives["stop"], change)
    # Distances become whole counts of 0.3 nm; where the run begins between two, all are rounded.
    within_m = 1e-8 if change is starting_late else 1e-9
    assert_same(start().profile_of(recording, tmp_path / "run"), expected(recording), within_m)


def test_single_precision_is_within_a_fifth_of_a_millimetre(
    start, drives, expected, assert_same, tmp_path
):
    found = start("REAL=float").profile_of(drives["stop"], tmp_path / "run")
    assert_same(found, expected(drives["stop"]), within_m=2e-4)


def test_each_fault_shows_where_it_must_and_only_there(start, drives, expected, tmp_path):
    flags = {1: "BROKEN=1", 2: "STAGE=basic", 3: "BROKEN=2"}
    made = {
        (fault, drive): start(flag).profile_of(drives[drive], tmp_path / f"{fault}-{drive}")
        for fault, flag in flags.items()
        for drive in ("constant", "stop")
    }
    roughness = {key: iri(p.tracks[0].elevation, p.interval_m) for key, p in made.items()}
    right = {d: expected(drives[d]).tracks[0] for d in ("constant", "stop")}
    true = {d: iri(track.elevation, 0.00508) for d, track in right.items()}
    assert roughness[1, "constant"] > 1.5 * true["constant"]
    assert roughness[2, "constant"] == pytest.approx(true["constant"], rel=0.05)
    assert roughness[2, "stop"] > 2 * true["stop"]
    for drive, track in right.items():
        broken = made[3, drive].tracks[0]
        np.testing.assert_allclose(broken.elevation, track.elevation, rtol=0, atol=1e-9)
        assert broken.valid.all()
        assert not track.valid.all()


def test_a_run_takes_memory_once_however_long_it_is(counted, simulated, tmp_path):
    taken = []
    for length_m in (150.0, 300.0):
        firmware, folder = counted(), tmp_path / f"{length_m:g}"
        firmware.profile_of(simulated(length_m=length_m, tracks=("main",)), folder)
        taken.append(firmware.end()[1].count("taken"))
    assert 0 < taken[0] == taken[1] < 20
