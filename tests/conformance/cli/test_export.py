"""`conformance export`: the command that it tells judges what was exported."""

import shlex

import pytest
from click.testing import CliRunner

from floatref_conformance import exporting, golden
from floatref_conformance.cli import export
from floatref_conformance.cli.main import main


@pytest.mark.parametrize("ids", [(), ("toy",), ("toy", "second")])
def test_the_command_for_afterwards_quotes_the_folder_and_names_the_checks(
    ids, registry, monkeypatch, tmp_path
):
    out = tmp_path / "two words"
    monkeypatch.setattr(export, "load_registry", lambda edition: registry)
    monkeypatch.setattr(golden, "copy_to", lambda folder: None)
    monkeypatch.setattr(exporting, "export", lambda checks, folder, *_: (folder / "a").mkdir() or 3)
    asked = [word for id_ in ids for word in ("--check", id_)]
    answer = CliRunner().invoke(main, ["export", "--out", str(out), "--seed", "5", *asked])
    assert answer.exit_code == 0, answer.output
    command = shlex.split(answer.stdout.splitlines()[-1].partition("after processing: ")[2])
    options = ["--device", f"files:{out}", "--seed", "5", "--effort", "quick"]
    assert command == ["conformance", "run", *options, *asked]
