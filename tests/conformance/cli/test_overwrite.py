"""A target that exists: every command that can replace it says by which option, and leaves it."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from floatref import (
    Channel,
    Profile,
    ProfileTrack,
    Recording,
    UniformClock,
    write_profile,
    write_recording,
)
from floatref.cli.main import COMMANDS as OF_FLOATREF
from floatref.cli.main import main as floatref
from floatref_conformance.cli.main import COMMANDS as OF_CONFORMANCE
from floatref_conformance.cli.main import main as conformance
from floatref_conformance.proving_ground.scenario import Scenario

TINY = Scenario(length_m=20.0, rate_hz=1000.0, tracks=("left",), gnss=False)
TARGETS = {
    "process": ("process", "run", "--out", "old"),
    "convert": ("convert", "road", "--out", "old"),
    "tune": ("tune", "run", "--reference", "road", "--out", "old"),
    "vehicle": ("vehicle", "run", "--out", "old"),
    "allan": ("allan", "run", "--settings", "old"),
    "simulate": ("simulate", "case.json", "--out", "old"),
    "export": ("export", "--out", "old"),
    "submit": ("submit", "--out", "old"),
    "matrix": ("matrix", "report", "--out", "old.html"),
    "sample": ("sample", "network", "--out", "old"),
    "view": ("view", "road", "-o", "old.html"),
    "plot": ("plot", "road", "-o", "old.png"),
    "iri": ("iri", "road", "--gis", "old.geojson", "--recording", "run"),
    "roughness": ("roughness", "road", "--gis", "old.geojson", "--recording", "run"),
}
OPTION = ", or replace it with --overwrite"


def has_overwrite(group, name):
    return any("--overwrite" in p.opts for p in group.get_command(None, name).params)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with a recording, a profile, a scenario, and a target that exists."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.json").write_text(json.dumps(TINY.to_dict()))
    write_profile(
        Profile(0.25, (ProfileTrack.of("left", np.arange(99) * 1e-3),)), tmp_path / "road"
    )
    write_recording(
        Recording((Channel.of("height", np.zeros(99), UniformClock.of(9.0)),)), tmp_path / "run"
    )
    for name in ("old", "old.geojson", "old.html", "old.png"):
        (tmp_path / name).write_text("mine")
    return tmp_path


@pytest.mark.parametrize("name", TARGETS)
def test_the_option_is_named_where_there_is_one(name, folder):
    group = floatref if name in OF_FLOATREF else conformance
    before = sorted(folder.rglob("*"))
    ended = CliRunner().invoke(group, TARGETS[name])
    assert (ended.exit_code, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    target = next(word for word in TARGETS[name] if word.startswith("old"))
    assert f"{target}: exists; choose another name" in ended.stderr
    assert (OPTION in ended.stderr) == has_overwrite(group, name)
    assert sorted(folder.rglob("*")) == before
    assert (folder / target).read_text() == "mine"


def test_no_command_with_that_option_is_left_out():
    with_option = {n for n in OF_FLOATREF if has_overwrite(floatref, n)}
    with_option |= {n for n in OF_CONFORMANCE if has_overwrite(conformance, n)}
    assert with_option <= set(TARGETS)


def test_simulate_replaces_both_on_request(folder):
    words = ("simulate", "case.json", "--out", "new", "--truth", "truth")
    for seed in ("1", "2"):
        ended = CliRunner().invoke(conformance, [*words, "--seed", seed, "--overwrite"])
        assert ended.exit_code == 0, ended.output
    replaced = (folder / "new" / "left.height.f64").read_bytes()
    (folder / "case.json").write_text(json.dumps(replace(TINY, seed=2).to_dict()))
    CliRunner().invoke(conformance, ["simulate", "case.json", "--out", "fresh"])
    assert (folder / "fresh" / "left.height.f64").read_bytes() == replaced
    ended = CliRunner().invoke(conformance, [*words, "--overwrite", "--runs", "2"])
    assert ended.exit_code == 2
    assert "--overwrite: not together with --runs" in ended.stderr


def test_what_is_no_recording_is_never_replaced(folder):
    (folder / "papers").mkdir()
    (folder / "papers" / "thesis.txt").write_text("mine")
    ended = CliRunner().invoke(
        conformance, ["simulate", "case.json", "--out", "papers", "--overwrite"]
    )
    assert ended.exit_code == 2
    assert [p.name for p in (folder / "papers").iterdir()] == ["thesis.txt"]
