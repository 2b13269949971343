"""The study as one JSON object, ``conformance-faults/1``, and in the terminal."""

from collections import Counter
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from floatref_conformance.faults.fault_list import FAULTS
from floatref_conformance.faults.outcomes import Outcome
from floatref_conformance.faults.study import Study, Trial
from floatref_conformance.schemas import enforce

FORMAT = "conformance-faults/1"
WIDTH = 120
"""Columns of the output where the terminal's width is unknown."""
LISTED = (Outcome.SILENT, Outcome.WARNED)
"""What is listed trial by trial: valid points that are wrong."""


def study_document(study: Study) -> dict[str, Any]:
    """Return the JSON object of ``study``; SuiteError if it breaks its own schema."""
    made = {
        "format": FORMAT,
        "seed": study.settings.seed,
        "counts": {"shown": _counts(study, True), "all": _counts(study, None)},
        "healthy": [_trial(trial) for trial in study.healthy],
        "trials": [_trial(trial) for trial in study.trials],
    }
    enforce("conformance-faults-1", made)
    return made


def _counts(study: Study, tellable: bool | None) -> dict[str, int]:
    return {outcome.value: len(study.of(outcome, tellable)) for outcome in Outcome}


def _trial(trial: Trial) -> dict[str, Any]:
    return {
        "fault": trial.fault,
        "drive": trial.drive,
        "pipeline": trial.pipeline,
        "outcome": trial.outcome.value,
        "lines": list(trial.lines),
    }


def print_study(study: Study, console: Console) -> None:
    """Print the counts by pipeline and by sensor, then each trial whose valid points are wrong."""
    if not console.is_terminal:
        console.width = max(console.width, WIDTH)
    console.print(_table(study, "pipeline", lambda trial: trial.pipeline))
    console.print(_table(study, "sensor", lambda trial: FAULTS[trial.fault].sensor))
    for line in closing_lines(study):
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def closing_lines(study: Study) -> list[str]:
    """Return the totals, and the faults with valid points that are wrong."""
    lines = [_total(study, True), _total(study, None)]
    off = [t for t in study.healthy if t.outcome not in (Outcome.RIGHT, Outcome.FLAGGED)]
    lines += [f"healthy {t.drive}, {t.pipeline}: {t.outcome}" for t in off]
    for outcome in LISTED:
        for fault in dict.fromkeys(trial.fault for trial in study.of(outcome)):
            which = [t for t in study.of(outcome) if t.fault == fault]
            where = ", ".join(f"{t.drive} {t.pipeline}" for t in which)
            lines.append(f"{outcome}: {fault} ({FAULTS[fault].wrong}): {where}")
    return lines


def _total(study: Study, tellable: bool | None) -> str:
    silent = len(study.of(Outcome.SILENT, tellable))
    count = sum(len(study.of(outcome, tellable)) for outcome in Outcome)
    what = "faults that a recording can show" if tellable else "all faults"
    share = 100.0 * silent / max(count, 1)
    return f"Silently wrong: {silent} of {count} trials of {what}, {share:.2f} %"


def _table(study: Study, title: str, key: Any) -> Table:
    table = Table(box=SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column(title, no_wrap=True)
    for outcome in Outcome:
        table.add_column(outcome.value, justify="right")
    counts = Counter((key(trial), trial.outcome) for trial in study.trials)
    for name in dict.fromkeys(key(trial) for trial in study.trials):
        table.add_row(name, *(f"{counts[name, outcome]}" for outcome in Outcome))
    return table
