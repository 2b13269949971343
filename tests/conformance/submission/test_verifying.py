"""What an untouched archive confirms, and from what."""

import pytest
from tests.conformance.submission.tamperings import toy

from floatref_conformance.submission.findings import CaughtBy


def other_seed(submitted):
    """Give the archive a seed that draws other cases, and checksums that fit."""
    for name in ("submission.json", "report.json"):
        submitted.edit(name, lambda found: found.update(seed=found["seed"] + 1))
    submitted.renew_sums()


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


@pytest.mark.parametrize("stated", [{"hypothesis": "1.2.3"}, {}], ids=["another", "none"])
def test_cases_of_another_version_of_hypothesis_are_not_called_a_contradiction(archive, stated):
    submitted = archive("clipping")
    other_seed(submitted)
    assert [f.where for f in submitted.verify().findings] == ["results"]
    submitted.edit("submission.json", lambda found: found.update(environment=stated))
    submitted.renew_sums()
    found = submitted.verify()
    assert found.findings == []
    assert not found.is_confirmed
    assert stated.get("hypothesis", "no stated version") in found.undecided


def test_another_version_of_hypothesis_that_draws_the_same_is_confirmed(archive):
    submitted = archive("clipping")
    submitted.edit("submission.json", lambda f: f["environment"].update(hypothesis="1.2.3"))
    submitted.renew_sums()
    found = submitted.verify()
    assert found.is_confirmed
    assert any("hypothesis 1.2.3" in line for line in found.not_repeated)
