"""What an untouched archive confirms, and from what."""

import pytest
from tests.conformance.submission.tamperings import other_inputs, toy

from floatref_conformance.submission.findings import CaughtBy


def other_search(found):
    """Change a number of a case that a search has drawn, as another version of it may."""
    drawn = next(result for result in found if "-search-" in result["name"])
    drawn["parameters"]["scenario"]["speed_kmh"] = 33.25


def other_seeded(found):
    """Change a number of a case that edition and seed draw alone."""
    found[0]["parameters"]["scenario"]["speed_kmh"] = 33.25


def changed(submitted, change, **environment):
    """Return the archive with its results changed, another environment, and sums that fit."""
    submitted.edit("results/toy.json", change)
    submitted.edit("submission.json", lambda found: found["environment"].update(environment))
    submitted.renew_sums()
    return submitted


LATER = [pytest.param(name, marks=pytest.mark.slow) for name in ("good", "halving")]


@pytest.mark.parametrize("name", ["clipping", *LATER])
def test_an_untouched_archive_is_confirmed(archive, devices, name):
    found = archive(name).verify(devices[name](), every_case=True)
    assert found.findings == []
    assert found.claimed == ("INCOMPLETE" if name == "good" else "FAIL")
    assert any("cases on the device" in line for line in found.repeated)
    assert "unsigned" in found.signature


def test_a_failure_is_reproduced_from_the_archive_alone(archive):
    submitted = archive("clipping")
    simplest = toy(submitted.read("report.json"))["counterexample"]
    lines = [line for line in submitted.verify().repeated if simplest["case"] in line]
    assert any(f"fails: {simplest['reason']}" in line for line in lines)


def test_what_was_not_repeated_is_listed(archive):
    found = archive().verify()
    assert any("--device SPEC" in line for line in found.not_repeated)
    assert any("have no stored profiles" in line for line in found.not_repeated)


def test_another_device_than_the_submitted_is_named(archive, devices):
    found = archive("clipping").verify(devices["good"]())
    assert {f.caught_by for f in found.findings} == {CaughtBy.REPETITION}
    assert all(f.where.startswith("device: toy") for f in found.findings)


def test_another_search_by_another_version_of_hypothesis_is_no_contradiction(archive):
    assert [f.where for f in changed(archive("good"), other_search).verify().findings] == [
        "results"
    ]
    found = changed(archive("good"), other_search, hypothesis="1.2.3").verify()
    assert found.findings == []
    assert not found.is_confirmed
    assert "hypothesis 1.2.3" in found.undecided


@pytest.mark.parametrize("state", [dict.clear, lambda e: e.update(hypothesis="missing")])
def test_a_search_by_no_stated_version_is_a_contradiction(archive, state):
    submitted = archive("good")
    submitted.edit("submission.json", lambda found: state(found["environment"]))
    found = changed(submitted, other_search).verify()
    assert [f.where for f in found.findings] == ["results"]
    assert found.undecided == ""


@pytest.mark.parametrize("change", [other_seeded, lambda found: found.pop(0), list.reverse])
@pytest.mark.parametrize("name", ["good", "clipping"])
def test_no_version_of_hypothesis_explains_other_seeded_cases(archive, name, change):
    found = changed(archive(name), change, hypothesis="1.2.3").verify()
    assert [f.where for f in found.findings] == ["results"]
    assert found.undecided == ""


def test_a_verdict_against_its_outcomes_is_found_though_the_cases_are_undecided(archive):
    submitted = changed(archive("good"), other_search, hypothesis="1.2.3")
    submitted.edit("report.json", lambda found: found.update(verdict="FAIL"))
    submitted.renew_sums()
    found = submitted.verify()
    assert [f.where for f in found.findings] == ["report.json: verdict"]
    assert found.undecided


def test_another_version_of_hypothesis_that_draws_the_same_is_confirmed(archive):
    found = changed(archive("clipping"), lambda _: None, hypothesis="1.2.3").verify()
    assert found.is_confirmed
    assert any("hypothesis 1.2.3" in line for line in found.not_repeated)


def test_no_version_of_hypothesis_explains_other_recordings(archive):
    submitted = archive("clipping")
    other_inputs(submitted)
    found = changed(submitted, lambda _: None, hypothesis="1.2.3").verify()
    assert [f.where for f in found.findings] == ["answers: inputs"]


def test_other_sources_of_the_suite_may_make_other_recordings(archive):
    submitted = archive("clipping")
    other_inputs(submitted)
    suite = {"version": "0.0.1", "sha256": "0" * 64}
    submitted.edit("submission.json", lambda found: found.update(suite=suite))
    submitted.renew_sums()
    found = submitted.verify()
    assert found.findings == []
    assert any("other sources" in line for line in found.not_repeated)
