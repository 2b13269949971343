"""What a report says a failing device resembles, and when it says nothing."""

from types import SimpleNamespace

import numpy as np
import pytest

from floatref.cli.program.interrupts import Interrupt
from floatref_conformance.checks.verdict import CheckResult, Outcome, RunResult
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import Description
from floatref_conformance.mutants.device import make
from floatref_conformance.render.report import as_json
from floatref_conformance.render.wording import INDICATION, resemblance_lines
from floatref_conformance.resemblance import naming
from floatref_conformance.resemblance.catalogue import read_vectors
from floatref_conformance.resemblance.naming import (
    add_resemblance,
    name_by_features,
    was_interrupted,
)
from floatref_conformance.resemblance.probe_answers import ProbesTooLong
from floatref_conformance.resemblance.reviewing import by_word, review
from floatref_conformance.schemas import enforce

ABOUT = {"spec": "a:b", "name": "a", "version": "1", "architecture": "temporal", "capabilities": ()}


def result_of(outcome, reason=""):
    checks = (CheckResult("bounce", "R 57", outcome, reason),)
    return RunResult(ABOUT, DeviceClass.NOMINAL, 0, "quick", checks)


@pytest.fixture
def untouched(monkeypatch):
    """A device that fails the test when it is asked."""

    def refuse(*_):
        pytest.fail("the device was asked")

    monkeypatch.setattr(naming, "ask_probes", refuse)
    return SimpleNamespace()


@pytest.mark.parametrize("outcome", [Outcome.PASS, Outcome.SKIP, Outcome.WAIVED])
def test_a_device_that_does_not_fail_is_not_asked(untouched, outcome):
    assert add_resemblance(result_of(outcome), untouched).resemblance is None


def test_a_fault_of_the_protocol_needs_no_probe(untouched):
    failed = result_of(Outcome.ERROR, "bounce-1: run: was killed by SIGSEGV before it answered")
    (flaw,) = add_resemblance(failed, untouched).resemblance.flaws
    assert flaw.mutant == "crash"


def test_recorded_profiles_have_a_note(untouched):
    untouched.searchable = False
    found = add_resemblance(result_of(Outcome.FAIL), untouched).resemblance
    assert found.note == naming.NO_ANSWERS


def test_an_error_here_is_a_note_and_no_verdict_is_lost(monkeypatch):
    def fail(*_):
        raise ZeroDivisionError("out of\nluck")

    monkeypatch.setattr(naming, "measure_features", fail)
    found = add_resemblance(result_of(Outcome.FAIL), SimpleNamespace())
    assert found.verdict.value == "FAIL"
    assert "ZeroDivisionError: out of luck" in found.resemblance.note
    assert "out of luck" in resemblance_lines(found)[0]


def fail_with(error):
    def fail(*_, **__):
        raise error

    return fail


@pytest.mark.parametrize(
    ("error", "note"),
    [
        (Interrupt(), naming.INTERRUPTED),
        (ProbesTooLong(), naming.TOO_LONG),
        (ValueError("bad"), "not compared: ValueError: bad"),
    ],
)
def test_what_ends_the_probes_is_a_note_that_a_review_accepts(monkeypatch, error, note):
    monkeypatch.setattr(naming, "ask_probes", fail_with(error))
    device = SimpleNamespace()
    found = add_resemblance(result_of(Outcome.FAIL), device)
    assert found.verdict.value == "FAIL"
    assert found.resemblance.note == note
    assert was_interrupted(found) == isinstance(error, Interrupt)
    document = as_json(found)
    enforce("conformance-report-1", document)
    assert review(document, Description("a", "1", "temporal", ())) == ""
    assert by_word(document) == note


@pytest.mark.parametrize("mutant", ["laser-sign", "late-laser", "accelerometer-sign"])
def test_a_report_names_flaw_share_and_features(mutant):
    known = Description("a", "1", "temporal", ())
    features = next(f.features for f in read_vectors().flaws if f.mutant == mutant)
    # Every error nine tenths as large, as of a device of another kind.
    smaller = {n: x if x is None else float(np.round(0.9 * x, 3)) for n, x in features.items()}
    found = result_of(Outcome.FAIL)
    found = RunResult(**{**vars(found), "resemblance": name_by_features(smaller, known)})
    document = as_json(found)
    enforce("conformance-report-1", document)
    assert document["resemblance"]["flaws"][0]["mutant"] == mutant
    (line,) = resemblance_lines(found)
    assert f"({mutant}, " in line
    assert INDICATION in line
    assert resemblance_lines(result_of(Outcome.FAIL)) == []


@pytest.mark.slow
def test_a_mutant_resembles_its_own_flaw_by_its_answers():
    found = add_resemblance(result_of(Outcome.FAIL), make("upside-down")).resemblance
    assert found.flaws[0].mutant == "upside-down"
    assert found.flaws[0].alike > 0.95
