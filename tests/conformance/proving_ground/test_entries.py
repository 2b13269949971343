"""Laws of a cache folder that several processes share: no one trips over another's work."""

import errno
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from floatref_conformance.proving_ground import cache
from floatref_conformance.proving_ground.cache import simulate_cached
from floatref_conformance.proving_ground.entries import CHECKSUMS, is_intact
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate

TINY = Scenario(length_m=12.0, rate_hz=1000.0, tracks=("main",), gnss=False, imu=False)
OTHERS = 4
ROUNDS = 6
PROCESS = """
import json, pathlib, sys
from dataclasses import replace
from floatref_conformance.proving_ground.cache import simulate_cached
from floatref_conformance.proving_ground.scenario import Scenario

folder, number, others, rounds, document = json.loads(sys.argv[1])
folder, tiny = pathlib.Path(folder), Scenario.from_dict(document)

def meet(name):
    (folder / f"{name}.{number}").touch()
    while len(list(folder.glob(f"{name}.*"))) < others and not (folder / "failed").exists():
        pass

def read(scenario, largest):
    stored = simulate_cached(scenario, folder / "cache", largest)
    assert stored.recording.channel("height").values.size > 0
    assert stored.truth.tracks[0].elevation.size > 0
    return stored

try:
    for k in range(rounds):
        meet(f"damaged-{k}")
        stored = read(tiny, 1 << 30)
        meet(f"read-{k}")
        if number == 0 and k + 1 < rounds:
            (stored.recording_path / "height.f64").write_bytes(b"damaged.")
    for k in range(rounds):
        read(replace(tiny, seed=(k + number) % 2), 1)
except BaseException:
    (folder / "failed").touch()
    raise
"""


def damaged(entry: Path) -> None:
    (entry / "recording" / "height.f64").write_bytes(b"damaged.")


@pytest.mark.slow
def test_processes_share_a_folder(tmp_path: Path) -> None:
    """All start on an empty folder at once, then find it damaged, then evict each other."""
    running = []
    for number in range(OTHERS):
        arguments = json.dumps([str(tmp_path), number, OTHERS, ROUNDS, TINY.to_dict()])
        command = [sys.executable, "-c", PROCESS, arguments]
        running.append(subprocess.Popen(command, stderr=subprocess.PIPE))
    said = [process.communicate()[1].decode() for process in running]
    assert said == [""] * OTHERS
    assert [path for path in (tmp_path / "cache").iterdir() if path.name.startswith(".")] == []
    read = simulate_cached(TINY, tmp_path / "cache").recording.channel("height").values
    assert np.array_equal(read, simulate(TINY).recording.channel("height").values)


def test_damaged_entry_stays_until_the_new_one_is_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    entry = simulate_cached(TINY, tmp_path).recording_path.parent
    damaged(entry)

    def looking(scenario: Scenario) -> Simulation:
        assert entry.exists()
        return simulate(scenario)

    monkeypatch.setattr(cache, "simulate", looking)
    simulate_cached(TINY, tmp_path)
    assert is_intact(entry)


def test_good_entry_that_another_process_made_meanwhile_is_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    entry = simulate_cached(TINY, tmp_path).recording_path.parent
    damaged(entry)
    made: list[int] = []

    def second(scenario: Scenario) -> Simulation:
        monkeypatch.setattr(cache, "simulate", simulate)
        simulate_cached(TINY, tmp_path)
        made.append(entry.stat().st_ino)
        return simulate(scenario)

    monkeypatch.setattr(cache, "simulate", second)
    simulate_cached(TINY, tmp_path)
    assert made == [entry.stat().st_ino]
    assert [path.name for path in tmp_path.iterdir()] == [entry.name]


@pytest.mark.parametrize("number", [errno.EROFS, errno.EACCES, errno.EPERM])
def test_entry_that_cannot_be_marked_is_used_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    simulate_cached(TINY, tmp_path)

    def refused(path: Path) -> None:
        raise OSError(number, os.strerror(number), str(path))

    def again(scenario: Scenario) -> Simulation:
        raise AssertionError("simulated anew")

    monkeypatch.setattr(os, "utime", refused)
    monkeypatch.setattr(cache, "simulate", again)
    read = simulate_cached(TINY, tmp_path).recording.channel("height").values
    assert np.array_equal(read, simulate(TINY).recording.channel("height").values)


@pytest.mark.parametrize("prefix", [".new-", ".old-"])
def test_others_work_is_left_alone_for_a_day(tmp_path: Path, prefix: str) -> None:
    for name, hours in (("fresh", 1), ("abandoned", 25)):
        folder = tmp_path / f"{prefix}{name}"
        folder.mkdir()
        (folder / CHECKSUMS).write_text("{}", encoding="ascii")
        os.utime(folder, 2 * (time.time() - 3600 * hours,))
    simulate_cached(TINY, tmp_path, largest_bytes=1)
    assert [p.name for p in tmp_path.glob(f"{prefix}*")] == [f"{prefix}fresh"]


def test_only_entries_are_evicted(tmp_path: Path) -> None:
    kept = tmp_path / "measurements" / CHECKSUMS
    kept.parent.mkdir()
    kept.write_text("{}", encoding="ascii")
    simulate_cached(TINY, tmp_path, largest_bytes=1)
    assert kept.exists()
