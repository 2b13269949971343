"""The flaws in a report are found again from its features; others are named."""

from types import SimpleNamespace

import pytest

from floatref_conformance.checks.likeness import resemblance_document
from floatref_conformance.devices.interface import Description
from floatref_conformance.resemblance.catalogue import read_vectors
from floatref_conformance.resemblance.naming import name_by_features
from floatref_conformance.submission.findings import Verification
from floatref_conformance.submission.origins import describe_suite
from floatref_conformance.submission.verifying import check_resemblance

KNOWN = Description("a", "1", "temporal", ())
FAILED = {"id": "bounce", "outcome": "fail", "reason": "IRI 3 m/km"}


@pytest.fixture
def report():
    features = next(f.features for f in read_vectors().flaws if f.mutant == "late-laser")
    found = resemblance_document(name_by_features(features, KNOWN))
    return {"verdict": "FAIL", "checks": [FAILED], "resemblance": found}


def findings(report, suite=None):
    made = Verification()
    submitted = SimpleNamespace(suite=suite or describe_suite(), fault="", describe=lambda: KNOWN)
    check_resemblance(report, submitted, made)
    return made


def test_what_was_not_changed_is_confirmed(report):
    found = findings(report)
    assert found.findings == []
    assert any("resembles" in line for line in found.repeated)
    assert findings({**report, "resemblance": None}).repeated == []


@pytest.mark.parametrize(
    "change",
    [
        lambda r: r["resemblance"]["flaws"][0].update(alike=0.99999),
        lambda r: r["resemblance"]["flaws"][0].update(mutant="crash"),
        lambda r: r["resemblance"].update(flaws=[]),
        lambda r: r["resemblance"].update(features={"bounce: motion": 3.0}),
        lambda r: r["resemblance"].update(features={"bounce: motion": "3"}),
        lambda r: r["resemblance"].update(features=7),
        lambda r: r["resemblance"].update(note="no time"),
        lambda r: r.update(verdict="PASS"),
        lambda r: r["checks"].append(
            {"id": "stop", "outcome": "error", "reason": "stop-1: run: no answer within 60 s"}
        ),
        lambda r: r.update(resemblance=[1]),
    ],
)
def test_what_was_changed_is_named(report, change):
    change(report)
    (finding,) = findings(report).findings
    assert "resemblance" in finding.where


def test_with_other_sources_nothing_is_compared(report):
    report["resemblance"]["flaws"] = []
    found = findings(report, {"version": "0", "sources": "0"})
    assert found.findings == []
    assert any("resembles" in line for line in found.not_repeated)


def test_an_archive_that_names_other_flaws_is_not_confirmed(archive):
    def add(found):
        found["resemblance"] = {
            "found_by": "probes",
            "flaws": [{"mutant": "crash", "flaw": "it crashes", "alike": 1.0}],
            "least": 0.5,
            "features": {},
            "note": "",
        }

    changed = archive("clipping")
    changed.edit("report.json", add)
    changed.renew_sums()
    assert any("resemblance" in finding.where for finding in changed.verify().findings)
