"""`conformance faults`: names are checked before any work, and the list is printed."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from floatref_conformance.cli.main import main
from floatref_conformance.faults.fault_list import FAULTS


def run(*arguments: str) -> tuple[int, str]:
    found = CliRunner().invoke(main, ["faults", *arguments])
    return found.exit_code, found.output


def test_the_list_names_every_fault_and_what_no_recording_shows() -> None:
    code, text = run("--list")
    lines = text.splitlines()
    assert code == 0
    assert [line.partition(":")[0] for line in lines] == list(FAULTS)
    hidden = [line for line in lines if line.endswith("no recording can show it")]
    assert len(hidden) == sum(bool(fault.twin) for fault in FAULTS.values())


@pytest.mark.parametrize(
    ("option", "name"), [("--fault", "laser-in-miles"), ("--pipeline", "temporal-basics")]
)
def test_an_unknown_name_is_bad_input(option: str, name: str) -> None:
    code, text = run(option, name)
    assert code == 2
    assert name in text


def test_a_folder_is_no_file_to_write_and_said_so_before_the_work(tmp_path: Path) -> None:
    code, text = run("--out", str(tmp_path))
    assert code == 2
    assert text.splitlines()[-1] == (
        f"Error: {tmp_path}: is a folder; give the name of a file to write"
    )


@pytest.mark.slow
def test_a_study_of_one_fault_is_written_as_json(tmp_path: Path) -> None:
    out = tmp_path / "faults.json"
    chosen = ("--fault", "laser-in-mm", "--pipeline", "temporal-basic", "--drive", "constant")
    code, text = run(*chosen, "--out", str(out))
    assert code == 0
    assert "Silently wrong: 0 of 1 trials" in text
    (trial,) = json.loads(out.read_text(encoding="utf-8"))["trials"]
    assert trial["outcome"] == "refused"
    assert "multiply by 0.001" in trial["lines"][0]


@pytest.mark.slow
def test_a_healthy_drive_raises_no_alarm() -> None:
    code, text = run("--clean", "1", "--pipeline", "temporal-basic")
    assert code == 0
    assert "False alarms: 0 of 1 healthy drives" in text
