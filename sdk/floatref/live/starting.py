"""What a stream is to do: pipeline, settings and windows, settled before the first sample."""

from collections.abc import Mapping
from typing import Any

from floatref.builtin_pipelines.signal_flows import NEEDS
from floatref.engine.choosing import AUTO, BEST, choices_for, has_channels, missing_for
from floatref.engine.plugins import plugins
from floatref.errors import InputError
from floatref.interfaces.pipeline import OF_ALL, Pipeline
from floatref.live.bounds import CORE_M, LATE_S, RUN_OUT_S, Bounds
from floatref.live.declared_channels import example_of
from floatref.live.following import Order
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.plain import above_zero
from floatref.values.recording import Recording, Setup, check_interval

MOST_LATE_S = 600.0
"""Longest time in s that a stream waits for a channel."""


def settle(
    setup: Setup,
    clocks: Mapping[ChannelId, UniformClock | None],
    pipeline: str = AUTO,
    settings: Mapping[str, Any] | None = None,
    late_s: float = LATE_S,
) -> Order:
    """Return what a stream with channels of these ``clocks`` is to do.

    Raises InputError for a pipeline or setting that cannot be, a channel that the pipeline needs
    and the stream lacks, and a filter that does not settle within a window.
    """
    example, given = example_of(clocks, setup), dict(settings or {})
    names, reason = _pipelines(example, pipeline, given)
    known = plugins().pipelines()
    resolved = known[names[0]].resolve(given)
    interval_m = resolved.get("interval_m") or setup.profile_interval_m
    check_interval(interval_m, "setting interval_m")
    if above_zero("late_s", late_s) > MOST_LATE_S:
        raise InputError(f"late_s is {late_s:g}; give at most {MOST_LATE_S:g} s")
    bounds = Bounds.of(resolved, late_s)
    _check_settles(names[0], bounds)
    tracks = NEEDS[known[names[0]].architecture](example).tracks
    return Order(example, clocks, names, reason, given, interval_m, bounds, tracks)


def _pipelines(
    example: Recording, pipeline: str, given: Mapping[str, Any]
) -> tuple[tuple[str, ...], str]:
    """Return the pipelines to try for each window, the best first, and why that is the best."""
    known = plugins().pipelines()
    if pipeline != AUTO:
        missing = missing_for(example, plugins().pipeline(pipeline))
        if missing:
            raise InputError(
                f"pipeline {pipeline}: needs {missing}, which the stream has not; declare it or "
                "name another pipeline"
            )
        return (pipeline,), ""
    able = [(n, why) for n, why in BEST if n in known and has_channels(example, known[n])]
    if not able:
        choices_for(example, known)  # It names the channel that is missing.
    able = [(n, why) for n, why in able if _has(known[n], given)] or able[:1]
    return tuple(name for name, _ in able), able[0][1]


def _has(pipeline: Pipeline, given: Mapping[str, Any]) -> bool:
    return set(given) <= {*pipeline.settings, *OF_ALL}


def _check_settles(pipeline: str, bounds: Bounds) -> None:
    for name, found, most, unit in (
        ("cutoff_wavelength_m", bounds.settle_m, CORE_M, "m"),
        ("collective_cutoff_hz", bounds.settle_s, RUN_OUT_S, "s"),
    ):
        if found > most:
            raise InputError(
                f"setting {name}: the filter of pipeline {pipeline} settles in {found:.4g} {unit}, "
                f"and a live window has {most:.4g} {unit}; give a shorter wave, or process the "
                "recording after the run"
            )
