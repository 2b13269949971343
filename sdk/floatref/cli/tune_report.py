"""What `floatref tune` reports: values, scores of the runs, sensitivity, and what to doubt."""

from collections.abc import Iterator
from math import nan
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floatref.tuning.levels import UNITS

if TYPE_CHECKING:
    from floatref.tuning import Tuning
    from floatref.tuning.scores import Score
    from floatref.tuning.sensitivity import Sensitivity

FEELS = 0.02
"""A run whose loss rises by more depends on the precision of a value."""


def tune_report(tuning: "Tuning", out: Path) -> dict[str, Any]:
    """Return what `floatref tune --json` prints."""
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
    """Yield one line for each thing that the result does not silently hide."""
    yield from tuning.prepared.warnings
    if tuning.prepared.missing:
        yield f"recommended, and not among the runs: {'; '.join(tuning.prepared.missing)}"
    if not tuning.harmless:
        yield (
            "no values are as good as the nominal profiler at high speed and in light braking; "
            "look at these runs' scores before you use the settings"
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
    """Return factors and losses by run by setting, as the drawing takes them."""
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
