"""What `floatref tune` prints: values, the scores of the runs, and sensitivity."""

from collections.abc import Iterator
from math import isnan, nan
from pathlib import Path
from typing import TYPE_CHECKING

import click

from floatref.cli.printing import number, print_settings, print_table
from floatref.cli.tune_report import warnings_of
from floatref.tuning.levels import UNITS

if TYPE_CHECKING:
    from floatref.tuning import Tuning
    from floatref.tuning.scores import Score
    from floatref.tuning.sensitivity import Sensitivity

VALUES = ("setting", "before", "after", "as good from", "to", "unit")
AGREEMENT = (
    *("run", "kind", "track", "ρ nominal", "before", "after"),
    *("error of", "nominal", "before", "after"),
)
CHANGED = ("setting", "value", "loss at 0.71", "at 1", "at 1.41", "largest rise", "in")
ENOUGH = 10.0
"""Errors beyond tenfold are told as that."""


def print_tables(tuning: "Tuning", out: Path) -> None:
    """Print values, scores and sensitivity on stdout, and warnings on stderr."""
    print_table(str(out), VALUES, [_value_row(tuning, name) for name in tuning.values])
    rows = [row for name in tuning.prepared.runs for row in _run_rows(tuning, name)]
    print_table("Agreement with the reference", AGREEMENT, rows)
    print_table("Sensitivity", CHANGED, [_sensitivity_row(item) for item in tuning.sensitivity])
    for line in warnings_of(tuning):
        click.echo(f"Warning: {line}", err=True)
    print_settings(
        {
            "pipeline": tuning.pipeline,
            "loss_before": round(tuning.loss_before, 5),
            "loss_after": round(tuning.loss_after, 5),
            "rounds": tuning.rounds,
            "combinations": tuning.combinations,
            "profiles": tuning.profiles,
        }
    )


def _value_row(tuning: "Tuning", name: str) -> list[str]:
    values = (tuning.start[name], tuning.values[name], *tuning.ranges.get(name, (nan, nan)))
    return [name, *("–" if isnan(x) else f"{x:.4g}" for x in values), UNITS[name]]


def _run_rows(tuning: "Tuning", name: str) -> Iterator[list[str]]:
    """Yield a row for each wheel path; name and kind stand in the first."""
    comparison = tuning.prepared.runs[name].comparison
    each = (tuning.prepared.nominal[name], tuning.before[name], tuning.after[name])
    begin = [name, str(comparison.drive.kind)]
    for track, *scores in zip(comparison.reference.tracks, *each, strict=True):
        error = "IRI" if not isnan(scores[0].iri_error) else "peak"
        yield [
            *(*begin, track.name),
            *(number(score.cross_correlation, 4) for score in scores),
            "–" if isnan(scores[0].roughness_error) else error,
            *(_per_cent(score) for score in scores),
        ]
        begin = ["", ""]


def _sensitivity_row(item: "Sensitivity") -> list[str]:
    rise, name = item.worst
    losses = [number(loss, 4) for loss in item.mean_losses]
    return [item.setting, f"{item.value:.4g}", *losses, number(rise, 4), name]


def _per_cent(score: "Score") -> str:
    error = score.roughness_error
    if isnan(error):
        return "–"
    return f"{100.0 * error:+.1f} %" if error < ENOUGH else f"×{error + 1.0:.0f}"
