"""The flaws in a report are found again from its features; others are named."""

from types import SimpleNamespace

import pytest
from tests.conformance.submission.tamperings import resembling

from floatref_conformance.checks.likeness import resemblance_document
from floatref_conformance.devices.interface import Description
from floatref_conformance.resemblance import naming
from floatref_conformance.resemblance.catalogue import read_vectors
from floatref_conformance.resemblance.naming import name_by_features
from floatref_conformance.resemblance.reviewing import REMADE, Probed, probe_again
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
        lambda r: r["resemblance"].update(flaws=[], note="no time"),
        lambda r: r["resemblance"].update(flaws=[], note=naming.INTERRUPTED),
        lambda r: r["resemblance"].update(flaws=[], features={}),
        lambda r: r["resemblance"].update(flaws=[], features={}, note="no time"),
        lambda r: r["resemblance"]["features"].update({"bounce: motion": 1e308}),
        lambda r: r["resemblance"]["features"].update({"bounce: motion": 10**400}),
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


@pytest.mark.parametrize("note", [naming.INTERRUPTED, naming.TOO_LONG, naming.NO_ANSWERS])
def test_what_has_no_features_is_the_word_of_the_report(report, note):
    report["resemblance"].update(flaws=[], features={}, note=note)
    found = findings(report)
    assert (found.findings, found.repeated) == ([], [])
    (line,) = found.not_repeated
    assert f"by the word of the report, {note}" in line


def test_flaws_of_a_fail_that_are_not_there_are_named(report):
    for changed in ({**report, "resemblance": None}, {"verdict": "FAIL", "checks": [FAILED]}):
        (line,) = findings(changed).not_repeated
        assert "resembles: the report does not have them" in line
    assert findings({"verdict": "PASS", "resemblance": None}).not_repeated == []


@pytest.fixture
def probed(monkeypatch, report):
    """Return what the probes show of a report, on a device that has the features of ``report``."""
    measured = dict(report["resemblance"]["features"])
    monkeypatch.setattr(naming, "ask_probes", lambda *_, **__: ())
    monkeypatch.setattr(naming, "measure_features", lambda _: measured)
    return lambda changed: probe_again(changed, SimpleNamespace(), KNOWN)


def test_the_device_shows_features_that_were_changed_or_taken_away(report, probed):
    assert probed(report) == Probed()
    stated = report["resemblance"]
    name, value = next((n, x) for n, x in stated["features"].items() if x is not None)
    stated["features"][name] = value + 0.9 * REMADE
    assert probed(report) == Probed()
    stated["features"][name] = value + 1.1 * REMADE
    (line,) = probed(report).differences
    assert line.startswith(f"{name} is ")
    stated.update(features={}, flaws=[], note="no time")
    (line,) = probed(report).differences
    assert "name late-laser 1" in line
    stated.update(note=naming.INTERRUPTED)
    found = probed(report)
    assert found.differences == ()
    assert "name late-laser 1" in found.missing


def test_the_device_is_probed_only_where_probes_name_the_flaw(report, probed):
    crash = {"id": "stop", "outcome": "error", "reason": "stop-1: run: was killed by SIGSEGV"}
    for other in ({"resemblance": None}, {"verdict": "PASS"}, {"checks": [FAILED, crash]}):
        assert probed({**report, **other}) is None


def test_a_device_without_an_answer_in_time_repeats_nothing(report, monkeypatch):
    monkeypatch.setattr(naming, "LONGEST_S", 0.0)
    found = probe_again(report, SimpleNamespace(), KNOWN)
    assert found == Probed(missing=naming.TOO_LONG)


@pytest.mark.usefixtures("probed")
def test_a_device_at_hand_shows_what_a_note_hides(archive, devices):
    for note, found_in in (("no time", "findings"), (naming.INTERRUPTED, "not_repeated")):
        changed = archive("clipping")
        resembling(note)(changed)
        changed.renew_sums()
        found = changed.verify(devices["clipping"]())
        assert any("late-laser" in str(line) for line in getattr(found, found_in)), note


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
