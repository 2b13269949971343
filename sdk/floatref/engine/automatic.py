"""A recording to a profile, by the pipeline that is named, or by the best one."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from floatref.engine.advice.named_pipeline import (
    lost_at_stops,
    other_for_channels,
    without_reference,
)
from floatref.engine.choosing import AUTO, BEST, Choice, choices_for, passed_over
from floatref.engine.plugins import plugins
from floatref.engine.run import Progress, Result, run
from floatref.errors import InputError
from floatref.interfaces.pipeline import OF_ALL, Pipeline
from floatref.values.display.similar_names import hint_at
from floatref.values.recording import Recording


def run_named_or_best(
    recording: Recording,
    pipeline: str = AUTO,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    diagnostics: bool = False,
) -> Result:
    """Return what `run` does; with ``auto`` by the best pipeline that accepts the recording.

    Each better one that does not is named in a warning; the InputError of the last is raised.
    A warning says what a pipeline that is named cannot measure in the recording, and which can.
    """
    run_one = partial(run, recording, settings=settings, progress=progress, diagnostics=diagnostics)
    known, lines = plugins().pipelines(), list[str]()
    if pipeline != AUTO:
        plugins().pipeline(pipeline)
        return _run_named(partial(run_one, pipeline), recording, known[pipeline], known)
    able = choices_for(recording, known)
    lines += passed_over(recording, known)
    given = settings or {}
    # One that lacks a setting that is given is passed over; if all do, the best one says so.
    *better, last = [c for c in able if _has(known[c.pipeline], given)] or able
    for choice in better:
        known[choice.pipeline].resolve(given)  # A setting is no fault of the recording.
        try:
            return _with_choice(run_one(choice.pipeline), choice, lines)
        except InputError as error:
            lines.append(f"pipeline {choice.pipeline}: not taken; {error}")
    return _with_choice(run_one(last.pipeline), last, lines)


def _run_named(
    run_it: Callable[[], Result],
    recording: Recording,
    pipeline: Pipeline,
    known: Mapping[str, Pipeline],
) -> Result:
    """Return the result of ``pipeline`` with what it cannot measure, or its refusal so."""
    try:
        result = run_it()
    except InputError as error:
        raise InputError(f"{error}{other_for_channels(recording, pipeline, known)}") from error
    lines = *lost_at_stops(recording, result, known), *without_reference(recording, pipeline, known)
    return replace(result, warnings=(*lines, *result.warnings))


def _with_choice(result: Result, choice: Choice, lines: Sequence[str]) -> Result:
    """Return ``result`` with the ``choice`` in the profile's record."""
    chosen = {"by": AUTO, "reason": choice.reason}
    profile = replace(result.profile, provenance={**result.profile.provenance, "chosen": chosen})
    return replace(result, profile=profile, warnings=(*lines, *result.warnings))


def resolve_named_or_best(pipeline: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the settings of ``pipeline``, with the ``given`` ones replaced.

    With ``auto`` the recording decides: they are those of every pipeline that it may take and that
    has them all, by its name. Raises InputError for a pipeline or a setting that no recording can
    be processed with.
    """
    if pipeline != AUTO:
        return dict(plugins().pipeline(pipeline).resolve(given))
    known = plugins().pipelines()
    able = [known[name] for name, _ in BEST if name in known]
    found = {each.name: each.resolve(given) for each in able if _has(each, given)}
    if not found:
        names = ", ".join(sorted(given))
        of_all = {name for each in known.values() for name in each.settings}
        hint = "".join(hint_at(name, of_all) for name in given if name not in {*of_all, *OF_ALL})
        raise InputError(
            f"settings {names}: no pipeline of `{AUTO}` has them all; name the pipeline{hint}"
        )
    return found


def _has(pipeline: Pipeline, given: Mapping[str, Any]) -> bool:
    return set(given) <= {*pipeline.settings, *OF_ALL}
