"""The mutants: each fails just the checks that it names."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from floatref.files import read_profile, write_recording
from floatref_conformance.checks.bounce import BOUNCE
from floatref_conformance.checks.quiescent import QUIESCENT
from floatref_conformance.classes import Effort
from floatref_conformance.cli.main import main
from floatref_conformance.plugins import load_registry


def test_the_mutants_are_those_of_the_known_mistakes():
    names = {entry.name for entry in load_registry().kinds["mutant"].entries()}
    assert names >= {
        "all-zeros", "scaled", "previous-result", "swapped-tracks", "laser-sign", "height-only",
        "accelerometer-only", "late-laser",
    }  # fmt: skip


def test_a_mutant_that_remembers_begins_with_nothing(tmp_path):
    simulated = BOUNCE.cases(0, Effort.QUICK)[1].simulate()
    kind = load_registry().kinds["mutant"]
    delivered = []
    for n in range(2):
        write_recording(simulated.recording, tmp_path / f"{n}")
        kind.make("previous-result").run(tmp_path / f"{n}", tmp_path / f"p{n}")
        delivered.append(read_profile(tmp_path / f"p{n}").track("left").elevation)
        simulated = QUIESCENT.cases(0, Effort.QUICK)[1].simulate()
    assert not np.array_equal(*delivered)


@pytest.mark.parametrize(
    ("kind", "entry"), [(k, e) for k in ("mutant",) for e in load_registry().kinds[k].entries()]
)
def test_each_mutant_fails_the_checks_that_it_names(kind, entry, tmp_path):
    words = ["run", "--device", f"{kind}:{entry.name}", "--report", str(tmp_path)]
    answer = CliRunner().invoke(main, words)
    assert answer.exit_code == 1
    report = json.loads((tmp_path / "report.json").read_text())
    failed = {c["id"] for c in report["checks"] if c["outcome"] == "fail"}
    assert failed == set(entry.fails)
    assert entry.fails
