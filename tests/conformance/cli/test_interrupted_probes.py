"""Ctrl-C during the probes: the verdict is known, so that its reports are there, with code 130."""

import json

import pytest

from floatref.cli.program.interrupts import Interrupt
from floatref_conformance.cli import judging_options
from floatref_conformance.resemblance import naming


@pytest.fixture(autouse=True)
def _interrupted(call, monkeypatch):
    def interrupt(*_, **__):
        raise Interrupt

    monkeypatch.setattr(naming, "ask_probes", interrupt)
    # The toys of this folder go without probes otherwise.
    monkeypatch.setattr(judging_options, "add_resemblance", naming.add_resemblance)


def test_reports_of_a_run_are_there(run_toy, tmp_path):
    answer = run_toy("bad", "--resemblance", "--report", tmp_path / "r")
    assert answer.exit_code == 130
    assert [x for x in answer.stderr.splitlines() if x.startswith("Interrupted")] == [
        "Interrupted: the verdict is kept, without the flaw that it resembles"
    ]
    report = json.loads((tmp_path / "r" / "report.json").read_text(encoding="utf-8"))
    assert report["verdict"] == "FAIL"
    assert report["resemblance"]["note"] == naming.INTERRUPTED
    assert {"report.html", "junit.xml"} <= {path.name for path in (tmp_path / "r").iterdir()}
    assert "FAIL" in answer.stdout
    assert naming.INTERRUPTED in " ".join(answer.stdout.split())


def test_the_object_of_json_is_printed_whole(run_toy):
    answer = run_toy("bad", "--resemblance", "--json")
    assert answer.exit_code == 130
    assert json.loads(answer.stdout)["resemblance"]["note"] == naming.INTERRUPTED
