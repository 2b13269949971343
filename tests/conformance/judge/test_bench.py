"""The bench: what is simulated for a device, what it has processed, and what it flagged."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floatref.files import read_profile, write_profile
from floatref.values.profile import ProfileTrack
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError, DeviceSkipped
from floatref_conformance.judge import bench as bench_module
from floatref_conformance.judge.bench import DeviceBench, make_taken
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

TINY = Scenario(seed=5, length_m=20.0, rate_hz=1000.0, tracks=("left",), gnss=False, imu=False)


def described(*capabilities):
    return Description("fake", "1", "temporal", capabilities)


@pytest.mark.parametrize(
    "capabilities", [(), ("imu",), ("gnss",), ("response",), ("imu", "gnss", "response")]
)
def test_the_device_decides_which_channels_are_simulated(fake_device, taken, capabilities):
    asked = []

    def make(scenario):
        asked.append(scenario)
        return taken

    bench = DeviceBench(fake_device(), described(*capabilities), make)
    for scenario in (Scenario(seed=2), Scenario(seed=2, imu=False, gnss=False)):
        bench.simulate(scenario)
    given = {name: name in capabilities for name in ("imu", "gnss", "response")}
    assert asked == 2 * [Scenario(seed=2, **given)]


def same(taken, simulation):
    for channel in simulation.recording.channels:
        assert np.array_equal(taken.recording.channel(*channel.id).values, channel.values)
    for track in simulation.truth.tracks:
        assert np.array_equal(taken.truth.track(track.name).elevation, track.elevation)


def test_what_is_taken_is_what_is_simulated_with_and_without_a_cache(tmp_path, monkeypatch):
    expected = simulate(TINY)
    monkeypatch.setenv("FLOATREF_CACHE", str(tmp_path / "cache"))
    for _ in range(2):
        taken = make_taken(TINY)
        same(taken, expected)
    assert taken.scenario == TINY
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("FLOATREF_CACHE", str(tmp_path / "file" / "below"))
    same(make_taken(TINY), expected)


def test_without_a_package_that_finds_the_cache_it_is_simulated(monkeypatch):
    def missing(scenario):
        raise ImportError("no platformdirs")

    monkeypatch.setattr(bench_module, "simulate_cached", missing)
    same(make_taken(TINY), simulate(TINY))


@pytest.fixture
def taken():
    simulation = simulate(TINY)
    return Taken(simulation.recording, simulation.truth, TINY)


def test_what_the_device_processed_is_kept_in_order_with_its_label(fake_device, taken):
    bench = DeviceBench(fake_device(), described())
    profiles = [bench.run(taken, label) for label in ("first", "second")]
    assert [done.label for done in bench.passes] == ["first", "second"]
    assert [done.result for done in bench.passes] == profiles
    assert all(done.truth is taken.truth for done in bench.passes)
    assert {done.scenario for done in bench.passes} == {TINY}


def test_a_run_that_fails_is_not_kept(fake_device, taken):
    bench = DeviceBench(fake_device(lambda tracks: {}), described())
    with pytest.raises(DeviceError):
        bench.run(taken)
    assert bench.passes == []
    assert bench.flagged_m == 0.0


@pytest.mark.parametrize("doubts", [(0, 0), (40, 0), (0, 100), (100, 40)])
def test_the_largest_length_that_is_flagged_counts(fake_device, doubts):
    simulation = simulate(replace(TINY, tracks=("left", "right")))

    class Doubter(fake_device):
        """Vouches for all but the first points, as many as ``doubts`` says of a wheel path."""

        def run(self, recording, profile):
            super().run(recording, profile)
            made = read_profile(profile)
            tracks = tuple(
                ProfileTrack.of(t.name, np.array(t.elevation), np.arange(t.valid.size) >= count)
                for t, count in zip(made.tracks, doubts, strict=True)
            )
            write_profile(replace(made, tracks=tracks), profile, overwrite=True)

    bench = DeviceBench(Doubter(), described())
    bench.run(Taken(simulation.recording, simulation.truth, TINY))
    assert bench.flagged_m == pytest.approx(0.05 * max(doubts))


def test_a_wheel_path_that_nobody_asked_for_is_not_counted(fake_device, taken):
    def more(tracks):
        return {**tracks, "more": np.full(tracks["left"].size, np.nan)}

    bench = DeviceBench(fake_device(more), described())
    profile = bench.run(taken)
    assert not profile.track("more").valid.any()
    assert bench.flagged_m == 0.0


def overwritten(path):
    with path.open("r+b") as stream:
        stream.write(bytes(8))


def replaced(path):
    content = path.read_bytes()
    path.unlink()
    path.write_bytes(content[::-1])


SPOILT = {
    "left.height.f64": overwritten,
    "left.vertical_specific_force.f64": replaced,
    "distance.f64": Path.unlink,
    "recording.json": lambda path: path.write_text(path.read_text() + " "),
}


@pytest.mark.parametrize("name", SPOILT)
def test_a_device_that_changes_its_recording_is_at_fault(fake_device, taken, name):
    class Careless(fake_device):
        def run(self, recording, profile):
            super().run(recording, profile)
            SPOILT[name](recording.with_name(name))

    bench = DeviceBench(Careless(), described())
    with pytest.raises(DeviceError, match=f"^changed its recording: {name} differs after the run$"):
        bench.run(taken)
    assert bench.passes == []


def test_the_fault_of_a_run_that_fails_is_the_one_told(raising, taken):
    bench = DeviceBench(raising(DeviceSkipped("too short")), described())
    with pytest.raises(DeviceSkipped, match="too short"):
        bench.run(taken)
