"""`conformance selftest`: three counts, and an exit code that tells whether all of it holds."""

import json
from dataclasses import replace

import pytest
from click.testing import CliRunner

from floatref_conformance.cli import selftest
from floatref_conformance.cli.main import main
from floatref_conformance.editions.edition import find_edition

SMALL = ["selftest", "--check", "quiescent", "--processes", "1"]


def run(*options):
    return CliRunner().invoke(main, [*SMALL, *options])


@pytest.mark.slow
def test_limits_and_false_alarms_of_one_check():
    answer = run("--seeds", "0", "--false-alarms", "1", "--json")
    assert answer.exit_code == 0, answer.output
    document = json.loads(answer.stdout)
    assert document["holds"]
    assert document["complaints"] == []
    assert document["limits"] == document["limits_asked"] == 9
    reached = find_edition().document["reached"].values()
    asked = sum(bool(by_check.keys() & {"all", "quiescent"}) for by_check in reached)
    assert (document["false_alarms"], document["alarms_asked"]) == (0, asked)


@pytest.fixture
def two_mutants(monkeypatch):
    """Return a function that has two mutants name the checks that are given."""

    def name(zeros, vouching):
        killers = {"mutant:all-zeros": zeros, "mutant:vouches-always": vouching}
        monkeypatch.setattr("floatref_conformance.cli.selftest.find_killers", lambda _: killers)

    return name


@pytest.mark.slow
def test_mutants_that_are_killed(two_mutants):
    two_mutants(("quiescent",), ("stop",))
    answer = run("--seeds", "1", "--false-alarms", "0", "--no-limits")
    assert answer.exit_code == 0, answer.output
    assert "1 of 1 times killed" in answer.stdout
    assert "quiescent" in answer.stdout


@pytest.mark.slow
def test_a_mutant_that_survives(two_mutants):
    two_mutants(("quiescent",), ("quiescent",))
    answer = run("--seeds", "1", "--false-alarms", "0", "--no-limits")
    assert answer.exit_code == 1
    assert "mutant:vouches-always passes quiescent with seed 0" in answer.stdout
    assert "DOES NOT HOLD" in answer.stdout


def test_an_error_of_the_suite_is_no_count(monkeypatch):
    edition, reached = find_edition(), {"no-such-pipeline": {"all": "nominal"}}
    broken = replace(edition, document={**edition.document, "reached": reached})
    monkeypatch.setattr(selftest, "find_edition", lambda name: broken)
    answer = run("--seeds", "0", "--false-alarms", "1", "--no-limits")
    assert answer.exit_code not in (0, 1)


def test_an_unknown_check_is_wrong_usage():
    assert CliRunner().invoke(main, ["selftest", "--check", "nothing"]).exit_code == 2
