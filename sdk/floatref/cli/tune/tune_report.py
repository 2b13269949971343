"""The report of `floatref tune`: values, scores of the runs, sensitivity and warnings."""

from collections.abc import Iterator
from math import isnan, nan
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from floatref.cli.printing import number, print_settings, print_table
from floatref.tuning.levels import UNITS

if TYPE_CHECKING:
    from floatref.tuning import Tuning
    from floatref.tuning.run_scores import Score
    from floatref.tuning.sensitivity import Sensitivity

FEELS = 0.02
"""Rise of a run's loss above which it depends on the precision of a value."""


def tune_report(tuning: "Tuning", out: Path) -> dict[str, Any]:
    """Return the JSON document of `floatref tune --json`."""
    return {
        "pipeline": tuning.pipeline,
        "file": str(out),
        "settings": tuning.settings,
        "tuned": [_tuned_report(tuning, name) for name in tuning.values],
        "runs": [_run_report(tuning, name) for name in tuning.prepared.runs],
        "loss": {"before": tuning.loss_before, "after": tuning.loss_after},
        "sensitivity": [_sensitivity_report(item) for item in tuning.sensitivity],
        "rounds": tuning.rounds,
        "combinations": tuning.combinations,
        "profiles": tuning.profiles,
        "missing_runs": tuning.prepared.missing,
        "warnings": list(warnings_of(tuning)),
    }


def warnings_of(tuning: "Tuning") -> Iterator[str]:
    """Yield one line for each thing that the user of the result should know."""
    yield from tuning.prepared.warnings
    if tuning.prepared.missing:
        yield f"recommended, and not among the runs: {'; '.join(tuning.prepared.missing)}"
    if not tuning.harmless:
        yield (
            "no values are as good as the nominal profiler at high speed and in light braking; "
            "check these runs' scores before you use the settings"
        )
    for name, run in tuning.prepared.runs.items():
        limit = run.comparison.max_offset_m
        for track, score in zip(run.comparison.reference.tracks, tuning.after[name], strict=True):
            if limit > 0 and abs(score.offset_m) > limit - run.comparison.reference.interval_m:
                yield (
                    f"{name}: track {track.name} agrees best at the largest offset, "
                    f"{score.offset_m:.2f} m; give a larger --max-offset"
                )
    for item in tuning.sensitivity:
        rise, name = item.worst
        if rise > FEELS:
            yield (
                f"{name}: its loss rises by {rise:.3f} where {item.setting} is changed by half an "
                "octave; expect less on other days"
            )


def loss_curves(tuning: "Tuning") -> dict[str, dict[str, tuple[list[float], list[float]]]]:
    """Return factors and losses by setting and run, as the drawing needs them."""
    return {
        item.setting: {
            name: (list(item.scores), item.losses(name)) for name in tuning.prepared.runs
        }
        for item in tuning.sensitivity
    }


def _tuned_report(tuning: "Tuning", name: str) -> dict[str, Any]:
    low, high = tuning.ranges.get(name, (nan, nan))
    return {
        "setting": name,
        "unit": UNITS[name],
        "before": tuning.start[name],
        "after": tuning.values[name],
        "as_good_from": low,
        "as_good_to": high,
    }


def _run_report(tuning: "Tuning", name: str) -> dict[str, Any]:
    comparison = tuning.prepared.runs[name].comparison
    drive = comparison.drive
    tracks = [track.name for track in comparison.reference.tracks]
    each = (tuning.prepared.nominal[name], tuning.before[name], tuning.after[name])
    return {
        "run": name,
        "kind": str(drive.kind),
        "speed_kmh": drive.speed_kmh,
        "deceleration_g": drive.deceleration_g,
        "stop_s": drive.stop_s,
        "critical_m": drive.critical_m,
        "begin_m": comparison.begin_m,
        "end_m": comparison.end_m,
        "tracks": [
            {
                "name": track,
                "nominal": _score_report(nominal),
                "before": _score_report(before),
                "after": _score_report(after),
            }
            for track, nominal, before, after in zip(tracks, *each, strict=True)
        ],
    }


def _score_report(score: "Score") -> dict[str, float]:
    return {
        "cross_correlation": score.cross_correlation,
        "iri_error_percent": 100.0 * score.iri_error,
        "peak_error_percent": 100.0 * score.peak_error,
        "offset_m": score.offset_m,
    }


def _sensitivity_report(item: "Sensitivity") -> dict[str, Any]:
    rise, run = item.worst
    return {
        "setting": item.setting,
        "unit": UNITS[item.setting],
        "value": item.value,
        "factors": list(item.scores),
        "loss": item.mean_losses,
        "largest_rise": rise,
        "largest_rise_in": run,
    }


if TYPE_CHECKING:
    from floatref.tuning import Tuning
    from floatref.tuning.run_scores import Score
    from floatref.tuning.sensitivity import Sensitivity

VALUES = ("setting", "before", "after", "as good from", "to", "unit")
AGREEMENT = (
    *("run", "kind", "track", "ρ nominal", "before", "after"),
    *("error of", "nominal", "before", "after"),
)
CHANGED = ("setting", "value", "loss at 0.71", "at 1", "at 1.41", "largest rise", "in")
ENOUGH = 10.0
"""Relative error from which it is printed as a factor."""


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
    """Yield a row for each wheel path; name and kind are in the first."""
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
