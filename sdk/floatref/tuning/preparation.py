"""Before the search: kinds of the runs, their sections, and the nominal profiler's scores."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from floatref.engine.plugins import plugins
from floatref.engine.run import run
from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.tuning.levels import TUNED
from floatref.tuning.preliminary_runs import HIGH_KMH, RECOMMENDED, Kind, drive_of
from floatref.tuning.run_scores import Comparison, Scores, section
from floatref.tuning.trials import Preliminary
from floatref.values.profile import Profile
from floatref.values.recording import Recording

NOMINAL = "temporal-basic"
"""The nominal profiler: vertical accelerometer, height sensor and encoder alone."""
LEAST_CORRELATION = 0.5
"""Least cross correlation: below it, run and reference are not of the same road and places."""
FARTHEST_M = 25.0
"""Largest offset in m that is searched for the error message."""


@dataclass(frozen=True)
class Prepared:
    """The runs, their nominal scores, and warnings about them, one line each."""

    runs: Mapping[str, Preliminary]
    nominal: Mapping[str, Scores]
    warnings: tuple[str, ...]

    @property
    def kinds(self) -> dict[str, Kind]:
        """The runs' kinds by name."""
        return {name: run.comparison.drive.kind for name, run in self.runs.items()}

    @property
    def missing(self) -> tuple[str, ...]:
        """Descriptions of the recommended runs that are missing."""
        there = self.kinds.values()
        return tuple(text for kind, text in RECOMMENDED.items() if kind not in there)


def check_pipeline(name: str, given: Mapping[str, Any]) -> dict[str, float]:
    """Return the numbers of pipeline ``name`` with the settings ``given``.

    Raises InputError for a pipeline that is unknown or has no settings to tune, and for a setting
    that it cannot have.
    """
    known = plugins()
    pipeline = known.pipeline(name)
    if not set(TUNED) <= set(pipeline.settings):
        able = [n for n, p in known.pipelines().items() if set(TUNED) <= set(p.settings)]
        raise InputError(f"pipeline {name}: has no {TUNED[0]} to tune; take {', '.join(able)}")
    return {k: v for k, v in pipeline.resolve(given).items() if v is not None}


def prepare(
    recordings: Mapping[str, Recording],
    reference: Profile,
    pipeline: str,
    given: Mapping[str, Any],
    max_offset_m: float = 1.0,
    tell: Callable[[str], None] = lambda _: None,
) -> Prepared:
    """Return the runs in the order given; ``tell`` is called with the name of each.

    Raises InputError naming the run that cannot be used, and if no run is at high speed.
    """
    runs, nominal, warnings = {}, {}, []
    for name, recording in recordings.items():
        tell(f"Preparation of {name} (the first time, this compiles)")
        with name_errors(name):
            made, cautions = _preliminary(name, recording, reference, pipeline, given, max_offset_m)
            runs[name] = made
            nominal[name] = _nominal(made, given)
        warnings += [f"{name}: {line}" for line in cautions]
    prepared = Prepared(runs, nominal, tuple(warnings))
    _check_high_speed(prepared)
    return prepared


def _preliminary(
    name: str,
    recording: Recording,
    reference: Profile,
    pipeline: str,
    given: Mapping[str, Any],
    max_offset_m: float,
) -> tuple[Preliminary, tuple[str, ...]]:
    result = run(recording, pipeline, given)
    _check_tracks(reference, result.profile)
    begin_m, end_m = section(reference, result.profile)
    drive = drive_of(result.screening.travel, begin_m, end_m)
    comparison = Comparison(reference, begin_m, end_m, drive, max_offset_m)
    return Preliminary(name, recording, result.screening, comparison), result.warnings


def _nominal(made: Preliminary, given: Mapping[str, Any]) -> Scores:
    settings = {k: v for k, v in given.items() if k == "interval_m"}
    return made.comparison.scores(made.profile(NOMINAL, settings))


def _check_tracks(reference: Profile, profile: Profile) -> None:
    names = [track.name for track in profile.tracks]
    missing = [track.name for track in reference.tracks if track.name not in names]
    if missing:
        raise InputError(
            f"track {', '.join(missing)} of the reference is missing; the recording has "
            f"{', '.join(names)}; give both the same names"
        )


def _check_high_speed(prepared: Prepared) -> None:
    """Raise InputError unless there are runs at high speed, which all follow the reference."""
    fast = [name for name, kind in prepared.kinds.items() if kind is Kind.HIGH]
    if not fast:
        here = ", ".join(f"{name}: {kind}" for name, kind in prepared.kinds.items())
        raise InputError(
            f"no run at a constant speed of {HIGH_KMH:g} km/h or more, which is where tuning must "
            f"do no harm; record one, at 72 km/h or more ({here})"
        )
    for name in fast:
        made = prepared.runs[name]
        tracks = [track.name for track in made.comparison.reference.tracks]
        for index, score in enumerate(prepared.nominal[name]):
            if score.cross_correlation < LEAST_CORRELATION:
                hint = _hint(made, index)
                raise InputError(
                    f"{name}: track {tracks[index]} correlates by {score.cross_correlation:.2f} "
                    f"with the reference at high speed, where {LEAST_CORRELATION:g} is the least; "
                    f"{hint}"
                )


def _hint(made: Preliminary, index: int) -> str:
    """Return the remedy for a run that does not follow the reference."""
    comparison = made.comparison
    length_m = comparison.end_m - comparison.begin_m
    wider = replace(comparison, max_offset_m=min(FARTHEST_M, length_m / 5))
    score = wider.scores(made.profile(NOMINAL))[index]
    if score.cross_correlation < LEAST_CORRELATION:
        return "give one of the same road, wheel path and start of distance"
    return (
        f"it does by {score.cross_correlation:.2f} at an offset of {score.offset_m:.2f} m: give a "
        "larger --max-offset, or the same start of distance"
    )
