"""The reference confirms the worst numbers of a worksheet, and denies every wrong one."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from floatref_conformance.certify.judging import second_opinion
from floatref_conformance.certify.judging.contents import Worksheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.second_opinion import confirm_worksheet
from floatref_conformance.certify.judging.stationary import stationary_sheet
from floatref_conformance.certify.plan.plan_document import StationaryPlan
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli.main import main
from floatref_conformance.errors import SuiteError

LIMITS = CertificationLimits()


def worksheet_of(*sections, stationary=()):
    return Worksheet("", DeviceClass.NOMINAL, LIMITS, Verdict.PASS, sections, stationary)


@pytest.fixture(scope="module")
def section(sheet_of, ten_runs, run_over, without):
    """Three runs; the last is late, noisy, high, and has a hole."""
    late = replace(run_over(3, noise_m=2e-4, height=1.05), start_m=0.6)
    return sheet_of((*ten_runs[:2], without(late, "left", 700, 30)))


@pytest.fixture(scope="module")
def parked(ten_runs):
    plan = StationaryPlan(Path("parked"), (20.0, 120.0))
    return stationary_sheet("bounce", plan, ten_runs[0], LIMITS)


def changed(section, run, track, **numbers):
    """Return ``section`` with other numbers for one wheel path of one run."""
    tracks = tuple(
        replace(t, **numbers) if t.track == track else t for t in section.runs[run].tracks
    )
    runs = list(section.runs)
    runs[run] = replace(runs[run], tracks=tracks)
    return replace(section, runs=tuple(runs))


def test_what_was_measured_is_confirmed(section, parked):
    confirm_worksheet(worksheet_of(section, stationary=(parked,)))


def test_worksheets_without_numbers_are_left_alone(sheet_of):
    nothing = stationary_sheet("bounce", StationaryPlan(Path("a")), None, LIMITS)
    confirm_worksheet(worksheet_of(sheet_of(()), stationary=(nothing,)))


def worst(section):
    """Return run and wheel path of the lowest accuracy."""
    scores = {(k, t.track): t.accuracy for k, run in enumerate(section.runs) for t in run.tracks}
    return min(scores, key=scores.get)


def test_a_wrong_accuracy_is_denied_by_the_name_of_section_run_and_track(section):
    run, track = worst(section)
    score = next(t.accuracy for t in section.runs[run].tracks if t.track == track)
    wrong = changed(section, run, track, accuracy=score - 2e-3 * (1 - score))
    with pytest.raises(SuiteError, match=f"section main, run run-3, track {track}: loss of accur"):
        confirm_worksheet(worksheet_of(wrong))


def test_a_wrong_iri_is_denied(section):
    run = section.runs[2]
    track = max(run.tracks, key=lambda t: abs(t.bias_percent))
    wrong = changed(section, 2, track.track, iri_m_per_km=1.002 * track.iri_m_per_km)
    with pytest.raises(SuiteError, match="IRI is"):
        confirm_worksheet(worksheet_of(wrong))


def test_a_wrong_stationary_iri_is_denied(parked):
    wrong = {name: 1.002 * value for name, value in parked.iri_m_per_km.items()}
    with pytest.raises(SuiteError, match="certify, bounce, track"):
        confirm_worksheet(worksheet_of(stationary=(replace(parked, iri_m_per_km=wrong),)))


def test_the_reference_is_given_no_more_points_than_it_can_take_in_good_time(
    section, parked, monkeypatch
):
    given = []

    def noted(_, measured):
        evidence = measured.evidence
        pair = getattr(evidence, "pair", None)
        given.append(evidence.elevation.size if pair is None else pair.truth.size)

    monkeypatch.setattr(second_opinion, "confirm", noted)
    monkeypatch.setattr(second_opinion, "MOST_POINTS", 1500)
    confirm_worksheet(worksheet_of(section, stationary=(parked,)))
    assert given == [1500, 1500, 1500]


def test_of_a_long_section_the_measure_is_still_confirmed_and_a_wrong_one_denied(
    section, parked, monkeypatch
):
    monkeypatch.setattr(second_opinion, "MOST_POINTS", 1500)
    confirm_worksheet(worksheet_of(section, stationary=(parked,)))
    monkeypatch.setattr(second_opinion, "iri", lambda z, interval: float(np.abs(z).mean()))
    with pytest.raises(SuiteError, match="IRI is"):
        confirm_worksheet(worksheet_of(section))


def test_a_certification_whose_measure_is_wrong_ends_without_a_verdict(written, monkeypatch):
    from floatref_conformance.certify.judging import comparing

    right = comparing.iri
    monkeypatch.setattr(comparing, "iri", lambda z, interval: 1.01 * right(z, interval))
    runs = [str(written / "runs" / f"run-{k}") for k in (1, 2)]
    command = ["certify", *runs, "--reference", str(written / "reference"), "--section", "0:60"]
    result = CliRunner().invoke(main, command)
    assert result.exit_code == 3
    assert "by the reference" in result.output
    assert "PASS" not in result.output
