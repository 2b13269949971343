"""The main job for users: a recording to a profile, by the pipeline named, or by the best one."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from floatref.engine.choosing import AUTO, BEST, Choice, choices_for
from floatref.engine.plugins import plugins
from floatref.engine.run import FloatrefWarning, Progress, Result, run
from floatref.errors import InputError
from floatref.interfaces.pipeline import OF_ALL, Pipeline
from floatref.values.profile import Profile
from floatref.values.recording import Recording


def process(
    recording: Recording, pipeline: str = AUTO, settings: Mapping[str, Any] | None = None
) -> Profile:
    """Return the profile of ``recording`` by ``pipeline``.

    ``auto`` takes the pipeline that bears most, of those whose channels were recorded; the
    profile's record says which, and why. ``settings`` replaces the pipeline's defaults by name.
    Warns with `FloatrefWarning`. Raises InputError for a recording, pipeline or setting that cannot
    be used and PluginError if two plug-ins answer the same point.
    """
    result = run_named_or_best(recording, pipeline, settings)
    for line in result.warnings:
        warnings.warn(line, FloatrefWarning, stacklevel=2)
    return result.profile


def run_named_or_best(
    recording: Recording,
    pipeline: str = AUTO,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    diagnostics: bool = False,
) -> Result:
    """Return what `run` does; with ``auto`` by the best pipeline that accepts the recording.

    Each better one that does not is named in a warning; the InputError of the last is raised.
    """
    run_one = partial(run, recording, settings=settings, progress=progress, diagnostics=diagnostics)
    if pipeline != AUTO:
        return run_one(pipeline)
    known, lines = plugins().pipelines(), list[str]()
    *better, last = choices_for(recording, known)
    for choice in better:
        known[choice.pipeline].resolve(settings or {})  # A setting is no fault of the recording.
        try:
            return _with_choice(run_one(choice.pipeline), choice, lines)
        except InputError as error:
            lines.append(f"pipeline {choice.pipeline}: not taken; {error}")
    return _with_choice(run_one(last.pipeline), last, lines)


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
        raise InputError(
            f"settings {names}: no pipeline of `{AUTO}` has them all; name the pipeline"
        )
    return found


def _has(pipeline: Pipeline, given: Mapping[str, Any]) -> bool:
    return set(given) <= {*pipeline.settings, *OF_ALL}
