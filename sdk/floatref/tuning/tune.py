"""Tuning as a whole: preparation, procedure, result, and its sensitivity."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from floatref.engine.run import pipeline_capabilities
from floatref.tuning.levels import START, TUNED, Levels, Point, move
from floatref.tuning.preparation import Prepared, check_pipeline, prepare
from floatref.tuning.procedure import Found, Procedure, first_point
from floatref.tuning.run_scores import Scores
from floatref.tuning.sensitivity import Sensitivity, sensitivities
from floatref.tuning.trials import Trials
from floatref.values.profile import Profile
from floatref.values.recording import Recording

DEFAULT = "kalman-smoother-reflection"


@dataclass(frozen=True)
class Tuning:
    """What `tune` returns.

    Attributes:
        pipeline: which was tuned.
        settings: those given and those tuned, as `floatref process --settings` takes them.
        start, values: the tuned settings before and after.
        ranges: lowest and highest value of each that did as well in steps 2 to 4, where known.
        prepared: the runs, with the nominal profiler's scores.
        before, after: scores by run.
        loss_before, loss_after: mean over the runs, plus the harm against nominal at speed.
        sensitivity: to each standard deviation of Table 6.1.
        rounds: number of repetitions of steps 2 to 4.
        harmless: whether any values did no harm at high speed and in light braking.
        combinations, profiles: how many were tried, and made.
    """

    pipeline: str
    settings: Mapping[str, Any]
    start: Mapping[str, float]
    values: Mapping[str, float]
    ranges: Mapping[str, tuple[float, float]]
    prepared: Prepared
    before: Mapping[str, Scores]
    after: Mapping[str, Scores]
    loss_before: float
    loss_after: float
    sensitivity: tuple[Sensitivity, ...]
    rounds: int
    harmless: bool
    combinations: int
    profiles: int


def tune(
    recordings: Mapping[str, Recording],
    reference: Profile,
    pipeline: str = DEFAULT,
    given: Mapping[str, Any] | None = None,
    max_offset_m: float = 1.0,
    tell: Callable[[str], None] = lambda _: None,
    done: Callable[[int], None] = lambda _: None,
) -> Tuning:
    """Tune four settings of a Kalman ``pipeline`` to preliminary runs (section 6.4.4).

    Args:
        recordings: the runs by name; one at a constant, high speed is needed.
        reference: profile of their road, on the same axis of distance.
        pipeline: one that has the settings `TUNED`.
        given: fixed settings, and the start of the tuned ones: noise of sensors at rest.
        max_offset_m: largest offset of distance that is searched.
        tell: is called with a description of each step.
        done: is called after each profile with their number so far.

    Raises InputError for runs, a reference, a pipeline or settings that cannot be used.
    """
    given = {name: value for name, value in (given or {}).items() if value is not None}
    numbers = check_pipeline(pipeline, given)
    prepared = prepare(recordings, reference, pipeline, given, max_offset_m, tell)
    usual = check_pipeline(pipeline, {})
    levels = Levels.of(numbers, usual)
    trials = Trials(pipeline, given, levels, prepared.runs, done)
    with trials.open_workers():
        procedure = _procedure(prepared, levels, trials, first_point(given, levels), tell)
        found = procedure.search()
        tell("Sensitivity")
        chosen = levels.settings(found.point)
        varied = _find_varied(pipeline, numbers)
        sensitivity = sensitivities(trials, varied, chosen, list(prepared.runs))
    return Tuning(
        pipeline=pipeline,
        settings={**given, **chosen},
        start=levels.settings(START),
        values=chosen,
        ranges=_ranges(found, levels),
        prepared=prepared,
        before=trials.scores(levels.settings(START), list(prepared.runs)),
        after=trials.scores(chosen, list(prepared.runs)),
        loss_before=procedure.collective(START),
        loss_after=procedure.collective(found.point),
        sensitivity=tuple(sensitivity),
        rounds=found.rounds,
        harmless=found.harmless,
        combinations=trials.combinations,
        profiles=trials.profiles,
    )


def _procedure(
    prepared: Prepared,
    levels: Levels,
    trials: Trials,
    begin: Point,
    tell: Callable[[str], None],
) -> Procedure:
    nominal = {name: [score.loss for score in scores] for name, scores in prepared.nominal.items()}
    return Procedure(prepared.kinds, nominal, levels, trials.losses, begin, tell)


def _find_varied(pipeline: str, numbers: Mapping[str, float]) -> dict[str, float]:
    """Return the settings that ``pipeline`` uses."""
    gnss = "gnss" in pipeline_capabilities(pipeline)
    return {name: x for name, x in numbers.items() if gnss or not name.startswith("gnss_")}


def _ranges(found: Found, levels: Levels) -> dict[str, tuple[float, float]]:
    ranges = {}
    for which, name in enumerate(TUNED):
        if name in found.ranges:
            steps = found.ranges[name]
            low, high = (
                levels.settings(move(START, which, step))[name]
                for step in (steps.lowest, steps.highest)
            )
            ranges[name] = (low, high)
    return ranges
