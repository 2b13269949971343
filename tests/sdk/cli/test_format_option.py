"""Profile formats as a user calls them: written by `process`, read wherever a PROFILE is."""

import sys

import numpy as np
import pytest

from floatref.cli import process as process_module
from floatref.files import write_recording
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup

SUFFIXES = ("", ".csv", ".erd", ".parquet")


@pytest.fixture(scope="module")
def folder(tmp_path_factory, ran):
    """Profiles of one recording in every format: 60 m at 10 m/s, with a short laser drop-out."""
    place = tmp_path_factory.mktemp("formats")
    clock = UniformClock.of(1000.0)
    times = np.arange(6000) / 1000.0
    height = 0.3 + 0.004 * np.sin(9.0 * times)
    force = 9.80665 + 1e-3 * np.sin(9.0 * times)
    height[3000:3040] = np.nan
    channels = [
        Channel.of("distance", 10.0 * times, clock),
        Channel.of("height", height, clock, "left"),
        Channel.of("vertical_specific_force", force, clock, "left"),
    ]
    write_recording(Recording(tuple(channels), Setup(profile_interval_m=0.05)), place / "run")
    for suffix in SUFFIXES:
        ran("process", place / "run", "--out", place / f"made{suffix}")
    return place


def test_every_format_is_offered(folder, invoke, reported):
    assert "[profile|csv|erd|text|parquet]" in invoke("process", "--help").output
    listed = reported("adapters")["formats"]
    assert [(f["name"], f["suffix"]) for f in listed] == [
        ("profile", ""),
        ("csv", ".csv"),
        ("erd", ".erd"),
        ("text", ".txt"),
        ("parquet", ".parquet"),
    ]
    assert "ERD of UMTRI" in invoke("adapters").output


@pytest.mark.parametrize("suffix", SUFFIXES[1:])
def test_iri_is_that_of_the_profile_directory(folder, suffix, reported):
    expected = reported("iri", folder / "made")
    found = reported("iri", folder / f"made{suffix}")
    assert found["tracks"][0]["invalid_m"] == expected["tracks"][0]["invalid_m"] > 0
    assert found["tracks"][0]["iri_m_per_km"] == pytest.approx(
        expected["tracks"][0]["iri_m_per_km"], rel=1e-4
    )


def test_the_format_is_taken_by_name_too_and_a_target_is_not_replaced(folder, ran, refused):
    out = folder / "by_name.txt"
    ran("process", folder / "run", "--out", out, "--format", "erd")
    assert out.read_bytes() == (folder / "made.erd").read_bytes()
    assert "exists" in refused("process", folder / "run", "--out", out, "--format", "erd")
    assert "suffix .bin is no format; use .csv, .erd, .txt, .parquet, no suffix" in refused(
        "process", folder / "run", "--out", folder / "p.bin"
    )
    assert not list(folder.glob(".floatref-*"))


def test_a_missing_library_is_told_before_the_work(folder, monkeypatch, refused):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setattr(process_module, "make_profile", None)
    assert "b.parquet: writing Parquet needs pyarrow; run in a clone of floatref: pip" in refused(
        "process", folder / "run", "--out", folder / "b.parquet"
    )


def test_a_broken_file_is_one_line_and_exit_code_2(folder, refused):
    for suffix in (".erd", ".parquet"):
        broken = folder / f"broken{suffix}"
        broken.write_bytes((folder / f"made{suffix}").read_bytes()[:900])
        for command in (["iri", broken], ["compare", folder / "made", broken]):
            assert refused(*command).startswith(f"Error: {broken}: ")
