"""Sample data: drawn alike from a seed, complete or not at all, and of use for its command."""

import hashlib
import json
from dataclasses import replace

import pytest
from click.testing import CliRunner

from floatref.cli.main import main as floatref
from floatref.files import read_recording
from floatref_conformance.certify.plan.plan_document import read_plan
from floatref_conformance.cli.main import main
from floatref_conformance.cli.sample import KINDS
from floatref_conformance.samples import certification, network

FEW = ("north/run-1", "south/run-4")
SMALL = {
    certification: {
        "RUNS": 2,
        "PASS": replace(certification.PASS, rate_hz=1000.0),
        "PARKED": replace(certification.PARKED, rate_hz=1000.0),
    },
    network: {"DRIVES": {name: replace(network.DRIVES[name], rate_hz=1000.0) for name in FEW}},
}


@pytest.fixture
def small(monkeypatch):
    """Samples of two drives, at a low rate."""
    for module, names in SMALL.items():
        for name, value in names.items():
            monkeypatch.setattr(module, name, value)


def call(*words):
    return CliRunner().invoke(main, ["sample", *map(str, words)])


def digest(folder):
    """Return the content of every file in ``folder`` by its name."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
    }


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_a_seed_draws_one_sample_and_another_seed_another(kind, small, tmp_path):
    for name, seed in (("one", 3), ("same", 3), ("other", 4)):
        assert call(kind, "--out", tmp_path / name, "--seed", seed).exit_code == 0
    one, same, other = (digest(tmp_path / name) for name in ("one", "same", "other"))
    assert one == same
    assert one.keys() == other.keys()
    alike = {name for name in one if one[name] == other[name]}
    assert not {name for name in alike if name.endswith("height.f64")}


@pytest.mark.slow
def test_the_plan_names_what_is_there(small, tmp_path):
    done = call("certification", "--out", tmp_path / "c")
    command = done.stdout.splitlines()[-1]
    assert command.startswith(f"Next: conformance certify --plan {tmp_path / 'c' / 'plan.toml'}")
    plan = read_plan(tmp_path / "c" / "plan.toml")
    (section,) = plan.sections
    assert len(section.runs) == 2
    assert section.stretch_m[1] - section.stretch_m[0] == pytest.approx(160.93)
    assert len(plan.distance.readings_m) == certification.READINGS


@pytest.mark.slow
def test_the_network_has_one_recording_that_cannot_be_read(small, tmp_path):
    call("network", "--out", tmp_path / "n")
    read_recording(tmp_path / "n" / "north" / "run-1")
    with pytest.raises(ValueError, match=network.CUT):
        read_recording(tmp_path / "n" / network.DAMAGED)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("certification",), "Missing option '-o' / '--out'"),
        (("roads", "--out", "new"), "'roads' is not one of 'certification', 'network'"),
        (("network", "--out", "old"), "old: exists; choose another name"),
        (("network", "--out", "no/new"), "new: its folder does not exist"),
        (("network", "--out", "new", "--seed", "-1"), "Invalid value for '--seed'"),
    ],
)
def test_wrong_usage_is_one_line_and_leaves_nothing(words, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "old").mkdir()
    done = call(*words)
    assert (done.exit_code, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert said in done.stderr
    assert [path.name for path in tmp_path.rglob("*")] == ["old"]


def test_an_error_in_the_midst_leaves_nothing(small, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(network, "write_recording", full)
    assert call("network", "--out", tmp_path / "n").exit_code == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_the_whole_sample_of_a_certification_passes_its_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = call("certification", "--out", "sample")
    words = done.stdout.splitlines()[-1].removeprefix("Next: conformance ").split()
    judged = CliRunner().invoke(main, [*words, "--json"])
    worksheet = json.loads(judged.stdout)
    assert (judged.exit_code, worksheet["verdict"]) == (0, "PASS")
    assert len(worksheet["sections"][0]["runs"]) == certification.RUNS
    assert (tmp_path / "sample-report" / "worksheet.html").is_file()


@pytest.mark.slow
def test_the_whole_network_is_processed_but_for_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = call("network", "--out", "sample")
    words = done.stdout.splitlines()[-1].removeprefix("Next: floatref ").split()
    batch = json.loads(CliRunner().invoke(floatref, [*words, "--json"]).stdout)
    assert batch["files"]["done"] == len(network.DRIVES) - 1
    assert [failure["name"] for failure in batch["failures"]] == [network.DAMAGED]
