"""The study: no fault of a sample is silently wrong, and healthy drives raise no alarm."""

import pytest

from floatref.errors import InputError
from floatref_conformance.faults.clean_drives import clean_scenarios, try_clean_drives
from floatref_conformance.faults.outcomes import Outcome
from floatref_conformance.faults.study import (
    HEALTHY,
    StudySettings,
    make_study,
    try_fault,
)
from floatref_conformance.faults.study_document import closing_lines, study_document

PIPELINE = "temporal-adaptive-hpf-spatial-backward"
REFUSED = (
    "accelerometer-sign-about-rest",
    "accelerometer-scale-0.5",
    "accelerometer-stuck-all-with-dither",
    "laser-sign-about-median",
    "laser-scale-2",
    "laser-clock-1-percent-slow",
    "sides-lasers-swapped",
    "sides-one-accelerometer-twice",
    "encoder-in-feet",
)
"""Faults that make a recording useless; before the screening all were believed."""
NOT_VALID = (
    "accelerometer-late-50-ms",
    "accelerometer-noise-only-1-s",
    "accelerometer-stuck-to-the-end",
    "laser-late-50-ms",
    "laser-noise-added",
    "laser-scale-halved-midway",
    "encoder-fifth-lost",
    "encoder-late-3-s",
)
"""Faults of which the wrong points are not valid."""


def outcome(fault: str, drive: str) -> Outcome:
    (trial,) = try_fault(fault, drive, (PIPELINE,))
    return trial.outcome


@pytest.mark.slow
def test_a_healthy_drive_is_right() -> None:
    assert outcome(HEALTHY, "constant") is Outcome.RIGHT


@pytest.mark.slow
@pytest.mark.parametrize("fault", REFUSED)
def test_a_useless_recording_is_refused(fault: str) -> None:
    assert outcome(fault, "constant") is Outcome.REFUSED


@pytest.mark.slow
@pytest.mark.parametrize("fault", NOT_VALID)
def test_what_is_wrong_is_not_valid(fault: str) -> None:
    assert outcome(fault, "constant") in (Outcome.FLAGGED, Outcome.RIGHT)


@pytest.mark.slow
def test_the_study_counts_every_trial_and_leaves_out_what_no_recording_shows() -> None:
    chosen = ("laser-in-mm", "laser-step-20-mm")
    seen: list[str] = []
    made = make_study(StudySettings(chosen, ("constant",), ("temporal-basic",)), seen.append)
    document = study_document(made)
    assert seen == ["constant: healthy", *(f"constant: {name}" for name in chosen)]
    assert sum(document["counts"]["all"].values()) == 2
    assert sum(document["counts"]["shown"].values()) == 1
    assert closing_lines(made)[0].startswith("Silently wrong: 0 of 1 trials")


@pytest.mark.slow
def test_healthy_drives_of_the_families_raise_no_alarm() -> None:
    made = try_clean_drives(4, seed=11, pipelines=("temporal-basic",))
    assert made.drives == 4
    assert not made.alarms


def test_clean_drives_are_those_of_every_condition_in_turn() -> None:
    names = [name for name, _ in clean_scenarios(80)]
    assert len(set(names)) == 80
    assert names[0].endswith(" 1")
    assert names[38].endswith(" 2")


@pytest.mark.parametrize(
    "wrong", [{"drives": ("uphill",)}, {"faults": ("laser",)}, {"pipelines": ("best",)}]
)
def test_unknown_names_are_refused(wrong: dict[str, tuple[str, ...]]) -> None:
    with pytest.raises(InputError, match="unknown"):
        StudySettings(**wrong)
