"""Every parser has a fuzzer, and the driver of our own finds a planted fault."""

import ast
import importlib
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from floatref.engine.plugins import plugins

ROOT = Path(__file__).parents[2]
FOLDER = Path(__file__).parent
ROOMS = ("sdk/floatref", "adapters/floatref_adapters", "conformance/floatref_conformance")
DOOR = {
    *("open_bytes", "read_bytes", "read_start", "map_bytes", "check_file"),
    *("read_document", "parse_document", "read_toml"),
}
READ_BY = {
    "adapters/floatref_adapters/formats/arrow": ("parquet", "arrow", "profile_parquet"),
    "adapters/floatref_adapters/formats/can_log": ("can", "can_database"),
    "adapters/floatref_adapters/formats/csv_table": ("csv",),
    "adapters/floatref_adapters/formats/erd": ("erd", "any_profile"),
    "adapters/floatref_adapters/formats/hdf5": ("hdf5",),
    "adapters/floatref_adapters/formats/mcap_log": ("mcap",),
    "adapters/floatref_adapters/formats/mdf4": ("mdf4",),
    "adapters/floatref_adapters/formats/nmea": ("nmea",),
    "adapters/floatref_adapters/formats/novatel": ("novatel",),
    "adapters/floatref_adapters/formats/tdms": ("tdms",),
    "adapters/floatref_adapters/formats/viewer_text": ("viewer_text", "any_profile"),
    "adapters/floatref_adapters/shared/text_lines.py": ("nmea", "can"),
    "conformance/floatref_conformance/case_files.py": ("case",),
    "conformance/floatref_conformance/certify/plan/plan_document.py": ("plan",),
    "conformance/floatref_conformance/certify/practice": ("practice",),
    "conformance/floatref_conformance/devices/recorded.py": ("recorded_device",),
    "conformance/floatref_conformance/judge/waivers.py": ("waivers",),
    "conformance/floatref_conformance/matrix/stored_reports.py": ("report",),
    "conformance/floatref_conformance/proving_ground/roads/crg.py": ("open_crg",),
    "conformance/floatref_conformance/proving_ground/scenario_file.py": ("scenario",),
    "conformance/floatref_conformance/submission/document.py": ("submission",),
    "conformance/floatref_conformance/submission/stored_zip.py": ("submission_archive",),
    "sdk/floatref/batch/jobs/manifest.py": ("manifest",),
    "sdk/floatref/batch/results/record.py": ("batch_record",),
    "sdk/floatref/files": ("profile_directory", "profile_csv", "recording_directory", "settings"),
    "sdk/floatref/interfaces/profile_format.py": ("any_profile",),
    "sdk/floatref/live/saved_state.py": ("live_state",),
    "sdk/floatref/live/session/arrow_stream.py": ("live_arrow",),
    "sdk/floatref/live/session/connections.py": ("token",),
    "sdk/floatref/live/session/json_lines.py": ("live_lines",),
    "sdk/floatref/live/session/run_directory.py": ("live_directory",),
    "sdk/floatref/mapping/channel_map/map_document.py": ("map",),
}
"""Entries that read what a module, or the modules of a folder, opens."""
NO_PARSER = {
    "conformance/floatref_conformance/certify/plan/converting.py": "looks for one name",
    "conformance/floatref_conformance/cli/submissions/submit.py": "takes a text as it is",
    "conformance/floatref_conformance/devices/descendants.py": "/proc",
    "conformance/floatref_conformance/devices/streams/resident_memory.py": "/proc",
    "conformance/floatref_conformance/golden/__init__.py": "files of the package",
    "conformance/floatref_conformance/proving_ground/cache.py": "sizes of our own cache",
    "conformance/floatref_conformance/proving_ground/entries.py": "our own cache, by checksums",
    "conformance/floatref_conformance/samples/network.py": "files that it has written",
    "conformance/floatref_conformance/submission/signatures.py": "ssh-keygen and minisign read it",
    "conformance/floatref_conformance/submission/stored_answers.py": "profiles, by their reader",
    "conformance/floatref_conformance/cli/submissions/verify.py": "archives, by their reader",
    "sdk/floatref/batch/results/summary.py": "the table that `floatref batch` itself has written",
    "sdk/floatref/batch/jobs/recognition.py": "looks for the start of a text",
    "sdk/floatref/live/session/peers.py": "messages, by their readers",
}


@pytest.fixture(scope="module", autouse=True)
def importable():
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(FOLDER))
        yield


@pytest.fixture(scope="module")
def entries(importable):
    return importlib.import_module("every_entry")


@pytest.fixture(scope="module")
def driving(importable):
    return importlib.import_module("plain_driver")


def opening_modules():
    """Yield the modules that open or parse what somebody else may have written."""
    for room in ROOMS:
        for path in (ROOT / room).rglob("*.py"):
            text = path.read_text(encoding="utf-8")
            # Few have one of the names at all, and parsing takes longest.
            tree = ast.parse(text if any(f"{name}(" in text for name in DOOR) else "")
            calls = (node.func for node in ast.walk(tree) if isinstance(node, ast.Call))
            names = {f.id if isinstance(f, ast.Name) else getattr(f, "attr", "") for f in calls}
            if names & DOOR and "testing" not in path.parts:
                yield path.relative_to(ROOT).as_posix()


def test_every_adapter_has_an_entry(entries):
    assert set(plugins().adapters()) == set(entries.ADAPTERS) | {"recording"}
    assert "recording_directory" in entries.ENTRIES
    assert set(entries.ADAPTERS.values()) <= set(entries.ENTRIES)


def test_every_profile_format_has_an_entry(entries):
    assert set(plugins().profile_formats()) == set(entries.PROFILES)
    assert set(entries.PROFILES.values()) <= set(entries.ENTRIES)


def test_every_module_that_opens_a_file_is_read_by_an_entry_or_stands_in_the_list(entries):
    named = {*READ_BY, *NO_PARSER}
    found = [*opening_modules()]
    places = {m: {p for p in named if m == p or m.startswith(f"{p}/")} for m in found}
    assert [module for module, place in places.items() if not place] == []
    assert named == {place for found in places.values() for place in found}
    assert {name for names in READ_BY.values() for name in names} <= set(entries.ENTRIES)


def test_every_fuzzer_of_the_folder_is_an_entry_or_draws_calls(entries):
    scripts = {path.name for path in FOLDER.glob("fuzz_*.py")}
    assert scripts == {words[0] for words in entries.ENTRIES.values()} | {"fuzz_c_library.py"}


def test_every_parser_has_a_sound_input(entries):
    seeds = importlib.import_module("parser_seeds")
    assert set(seeds.SEEDS) == set(importlib.import_module("parsers").PARSERS)


def test_kept_inputs_belong_to_an_entry_and_are_small(entries):
    kept = [path for path in (FOLDER / "corpus").rglob("*") if path.is_file()]
    assert {path.parent.name for path in kept} <= set(entries.ENTRIES)
    assert sum(path.stat().st_size for path in kept) < 20_000


@pytest.mark.parametrize("script", ["run", "nightly"])
def test_ci_runs_every_entry(script):
    text = (ROOT / ".ci" / script).read_text(encoding="utf-8")
    assert re.search(r"tests/fuzz/every_entry\.py .*--seconds", text)


def reads(data: bytes) -> None:
    """Read anything."""


def raises(data: bytes) -> None:
    if b"7" in data:
        raise KeyError("seven")


def hangs(data: bytes) -> None:
    if b"7" in data:
        time.sleep(60.0)


def leaves_a_file(data: bytes) -> None:
    if b"7" in data:
        os.close(tempfile.mkstemp()[0])


HELD: list[int] = []


def leaves_a_handle(data: bytes) -> None:
    if len(HELD) < 40:
        HELD.append(os.open(os.devnull, os.O_RDONLY))


def drive(driving, read, place, seconds=30.0):
    driver = driving.Driver(read, lambda: None, place)
    driver.run([b'{"a": 3.5}'], seconds, random.Random(1))
    return driver


@pytest.mark.posix
@pytest.mark.parametrize(
    ("read", "said"),
    [
        (raises, "KeyError: 'seven'"),
        (hangs, "not read within 0.2 s"),
        (leaves_a_file, "left behind in the temporary folder: tmp"),
    ],
)
def test_the_driver_finds_a_fault_and_stores_its_input(driving, monkeypatch, tmp_path, read, said):
    monkeypatch.setattr(driving, "LONGEST_S", 0.2)
    with pytest.raises(driving.Found, match=re.escape(said)):
        drive(driving, read, tmp_path / "input")
    assert b"7" in (tmp_path / "input").read_bytes()


@pytest.mark.posix
@pytest.mark.skipif(sys.platform != "linux", reason="handles are counted on Linux")
def test_the_driver_finds_handles_that_are_left(driving, tmp_path):
    try:
        with pytest.raises(driving.Found, match="handles are left open"):
            drive(driving, leaves_a_handle, tmp_path / "input", 0.5)
    finally:
        for handle in HELD:
            os.close(handle)


@pytest.mark.posix
def test_the_driver_finds_nothing_where_there_is_nothing(driving, tmp_path):
    assert drive(driving, reads, tmp_path / "input", 0.2).count > 10


@pytest.mark.posix
def test_an_entry_reads_for_its_seconds_and_keeps_what_is_new(tmp_path):
    command = [sys.executable, str(FOLDER / "every_entry.py"), "--seconds", "0.3", "waivers"]
    done = subprocess.run(
        [*command, "--corpora", str(tmp_path)], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stdout
    assert re.match(r"waivers, seed \d+: \d+ inputs, \d+ kept", done.stdout)
    assert [*(tmp_path / "waivers").iterdir()]
    assert [path.name for path in tmp_path.iterdir()] == ["waivers"]
