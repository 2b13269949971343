"""A command that reads a profile and is given a recording says what to do with it first."""

from pathlib import Path

import numpy as np
import pytest

from floatref import Channel, Recording, UniformClock, read_recording, write_recording
from floatref_adapters.testing import WRITERS

READERS = {
    "iri": lambda source: ("iri", source),
    "roughness": lambda source: ("roughness", source),
    "straightedge": lambda source: ("straightedge", source),
    "compare": lambda source: ("compare", source, source),
}
SOURCES = {"run": "recording", "run/recording.json": "recording"} | {
    f"run{suffix}": adapter for suffix, adapter in ((".mf4", "mdf4"), (".h5", "hdf5"))
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("recordings")
    clock, still = UniformClock.of(100.0), np.zeros(200)
    names = ("vertical_specific_force", "height", "distance")
    channels = tuple(Channel.of(name, still, clock) for name in names)
    write_recording(Recording(channels), made / "run")
    for name in SOURCES:
        if "." in name and "/" not in name:
            WRITERS[Path(name).suffix](read_recording(made / "run"), made / name, {})
    return made


@pytest.mark.parametrize("source", SOURCES)
@pytest.mark.parametrize("command", READERS)
def test_a_recording_is_refused_with_what_to_do(
    command: str, source: str, folder: Path, monkeypatch: pytest.MonkeyPatch, refused
) -> None:
    monkeypatch.chdir(folder)
    before = sorted(folder.rglob("*"))
    assert refused(*READERS[command](source)) == (
        f"Error: {source}: is a recording for adapter {SOURCES[source]}, no profile; process it "
        f"first: floatref process {source} --out PROFILE\n"
    )
    assert sorted(folder.rglob("*")) == before


def test_a_table_that_is_no_profile_keeps_its_own_error(tmp_path: Path, refused) -> None:
    (tmp_path / "table.csv").write_text("time_s,height_mm\n0,1\n", encoding="utf-8")
    assert "distance_m" in refused("iri", tmp_path / "table.csv")


@pytest.mark.parametrize("source", SOURCES)
def test_convert_says_what_a_recording_may_become(
    source: str, folder: Path, monkeypatch: pytest.MonkeyPatch, refused
) -> None:
    monkeypatch.chdir(folder)
    line = refused("convert", source, "--out", "new.csv")
    assert line.startswith(f"Error: {source}: ")
    assert "floatref process" in line
    assert not Path("new.csv").exists()
