"""The mutants: each fails just the checks that it names."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from floatref.files import read_profile, write_recording
from floatref_conformance.bench import taken_of
from floatref_conformance.checks.bounce import BOUNCE
from floatref_conformance.checks.quiescent import QUIESCENT
from floatref_conformance.classes import Effort
from floatref_conformance.cli.main import main
from floatref_conformance.plugins import load_registry

KNOWN = (
    "all-zeros",
    "scaled",
    "previous-result",
    "swapped-tracks",
    "laser-sign",
    "height-only",
    "accelerometer-only",
    "late-laser",
)


def test_the_mutants_are_those_of_the_known_mistakes():
    names = {entry.name for entry in load_registry().kinds["mutant"].entries()}
    assert names >= set(KNOWN)


def test_a_mutant_that_remembers_begins_with_nothing(tmp_path):
    case = BOUNCE.cases(0, Effort.QUICK)[1]
    kind = load_registry().kinds["mutant"]
    delivered = []
    for n in range(2):
        write_recording(taken_of(case.scenario).recording, tmp_path / f"{n}")
        kind.make("previous-result").run(tmp_path / f"{n}", tmp_path / f"p{n}")
        delivered.append(read_profile(tmp_path / f"p{n}").track("left").elevation)
        case = QUIESCENT.cases(0, Effort.QUICK)[1]
    assert not np.array_equal(*delivered)


@pytest.mark.parametrize("name", KNOWN)
def test_each_mutant_fails_the_checks_that_it_names(name, tmp_path):
    """The stationary checks, that is; `conformance selftest` holds all mutants to all checks."""
    (entry,) = (e for e in load_registry().kinds["mutant"].entries() if e.name == name)
    words = ["run", "--device", f"mutant:{name}", "--report", str(tmp_path)]
    answer = CliRunner().invoke(main, [*words, "--check", "quiescent", "--check", "bounce"])
    assert answer.exit_code == 1
    report = json.loads((tmp_path / "report.json").read_text())
    failed = {c["id"] for c in report["checks"] if c["outcome"] == "fail"}
    assert failed
    assert failed >= set(entry.fails) & {"quiescent", "bounce"}
