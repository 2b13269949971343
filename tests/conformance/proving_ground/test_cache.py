"""Laws of the cache: simulated once, remade when damaged, bounded, and keyed by the source."""

import os
import shutil
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from floatref_conformance.proving_ground import cache
from floatref_conformance.proving_ground.cache import cache_folder, simulate_cached, source_digest
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate

TINY = Scenario(length_m=20.0, rate_hz=1000.0, tracks=("main",), gnss=False, imu=False)


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> list[Scenario]:
    """Count the simulations that the cache asks for."""
    asked: list[Scenario] = []

    def counting(scenario: Scenario) -> Simulation:
        asked.append(scenario)
        return simulate(scenario)

    monkeypatch.setattr(cache, "simulate", counting)
    return asked


def test_entry_holds_recording_and_truth_of_the_simulation(tmp_path: Path) -> None:
    stored, direct = simulate_cached(TINY, tmp_path), simulate(TINY)
    for channel in direct.recording.channels:
        read = stored.recording.channel(*channel.id)
        assert np.array_equal(read.values, channel.values)
    truth = stored.truth
    assert truth.interval_m == direct.truth.interval_m
    assert np.array_equal(truth.tracks[0].elevation, direct.truth.tracks[0].elevation)
    assert stored.recording_path not in stored.truth_path.parents


def test_second_request_does_not_simulate(tmp_path: Path, counted: list[Scenario]) -> None:
    first, second = simulate_cached(TINY, tmp_path), simulate_cached(TINY, tmp_path)
    assert first == second
    assert counted == [TINY]
    simulate_cached(replace(TINY, seed=1), tmp_path)
    assert len(counted) == 2


@pytest.mark.parametrize("name", ["recording/*.f64", "truth/profile.json", "checksums.json"])
@pytest.mark.parametrize("damage", ["flip", "cut", "remove"])
def test_damaged_entry_is_made_again(
    tmp_path: Path, counted: list[Scenario], name: str, damage: str
) -> None:
    entry = simulate_cached(TINY, tmp_path).recording_path.parent
    victim = sorted(entry.glob(name))[0]
    content = victim.read_bytes()
    if damage == "remove":
        victim.unlink()
    elif damage == "cut":
        victim.write_bytes(content[:-1])
    else:
        victim.write_bytes(bytes([content[0] ^ 1]) + content[1:])
    again = simulate_cached(TINY, tmp_path)
    assert len(counted) == 2
    direct = simulate(TINY).recording.channel("height")
    assert np.array_equal(again.recording.channel("height").values, direct.values)


def test_least_recently_used_entries_go_first(tmp_path: Path, counted: list[Scenario]) -> None:
    one, two, three = (replace(TINY, seed=seed) for seed in (1, 2, 3))
    paths = [simulate_cached(s, tmp_path).recording_path.parent for s in (one, two)]
    size = sum(f.stat().st_size for f in paths[0].rglob("*") if f.is_file())
    os.utime(paths[0], (1, 1))
    os.utime(paths[1], (2, 2))
    simulate_cached(one, tmp_path)
    simulate_cached(three, tmp_path, largest_bytes=int(2.5 * size))
    assert paths[0].exists()
    assert not paths[1].exists()
    assert len(counted) == 3


def test_new_entry_stays_even_if_it_alone_is_too_large(tmp_path: Path) -> None:
    stored = simulate_cached(TINY, tmp_path, largest_bytes=1)
    assert stored.recording.channel("height").values.size > 0


def test_changed_source_is_not_answered_with_an_old_recording(
    tmp_path: Path, counted: list[Scenario], monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate_cached(TINY, tmp_path)
    monkeypatch.setattr(cache, "source_digest", lambda: "another model")
    simulate_cached(TINY, tmp_path)
    assert len(counted) == 2


@pytest.mark.parametrize(
    "changed",
    [
        "floatref_conformance.proving_ground/vehicles/motion.py",
        "floatref_conformance.proving_ground/data/sroubek/profile_1.txt",
        "floatref.measures/roughness/quarter_car.py",
        "floatref.kernels/state_variable.py",
        "floatref.values/recording.py",
        "floatref.files/samples.py",
    ],
)
def test_digest_covers_models_data_and_what_of_the_sdk_shapes_recordings(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, changed: str
) -> None:
    def copied(package: str) -> Path:
        copy = tmp_path / package
        if not copy.exists():
            shutil.copytree(Path(str(files(package))), copy)
        return copy

    monkeypatch.setattr(cache, "files", copied)
    before = source_digest.__wrapped__()
    assert source_digest.__wrapped__() == before
    victim = tmp_path / changed
    content = victim.read_bytes()
    victim.write_bytes(content[:-2] + bytes([content[-2] ^ 1]) + content[-1:])
    assert source_digest.__wrapped__() != before


@pytest.mark.parametrize("what", ["recording", "truth"])
def test_entry_evicted_before_it_is_read_is_made_again(
    tmp_path: Path, counted: list[Scenario], what: str
) -> None:
    stored = simulate_cached(TINY, tmp_path)
    simulate_cached(replace(TINY, seed=1), tmp_path, largest_bytes=1)
    assert not stored.recording_path.exists()
    assert getattr(stored, what) is not None
    assert counted[-1] == TINY


def test_nothing_is_left_when_a_simulation_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refusing(*_: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(cache, "write_profile", refusing)
    with pytest.raises(OSError, match="disk full"):
        simulate_cached(TINY, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_environment_names_another_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FLOATREF_CACHE", str(tmp_path / "here"))
    assert cache_folder() == tmp_path / "here"
    assert tmp_path / "here" in simulate_cached(TINY).recording_path.parents
    monkeypatch.delenv("FLOATREF_CACHE")
    assert cache_folder().name == "floatref"
