"""What `run` and `submit` are asked for alike: the options that say what is judged, and how."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import click

from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.verdict import RunResult
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.cli.options import (
    class_of,
    limit_time,
    pass_variables,
    tell_where_truth_is,
)
from floatref_conformance.devices.interface import Device
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.runner import Plan
from floatref_conformance.judge.search import check_installed
from floatref_conformance.judge.stream_judging import StreamPlan
from floatref_conformance.judge.waivers import read_waivers
from floatref_conformance.registry import Registry
from floatref_conformance.resemblance.naming import add_resemblance

Wrapped = TypeVar("Wrapped", bound=Callable[..., Any])
RECOMMENDED = "builtin:road-prior-smoother"
OPTIONS = (
    click.option(
        "--device",
        "spec",
        metavar="SPEC",
        default=RECOMMENDED,
        show_default=True,
        help="Device to judge; `conformance list` names them.",
    ),
    click.option(
        "--class",
        "device_class",
        type=click.Choice([c.value for c in DeviceClass]),
        help="Class whose limits decide.  [default: what a built-in claims, else nominal]",
    ),
    click.option(
        "--effort",
        type=click.Choice([e.value for e in Effort]),
        default=Effort.QUICK.value,
        show_default=True,
        help="How many cases each check draws.",
    ),
    click.option(
        "--check", "ids", metavar="ID", multiple=True, help="Run this check alone; may be repeated."
    ),
    click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True),
    click.option(
        "--waive",
        metavar="FILE",
        type=click.Path(dir_okay=False, path_type=Path),
        help="Known failures: a check's id and why, one a line.",
    ),
    click.option(
        "--device-timeout",
        metavar="SECONDS",
        type=click.FloatRange(min=0, min_open=True),
        help="Time for one recording.  [default: 60 s and twice its length]",
    ),
    click.option(
        "--resemblance/--no-resemblance",
        default=None,
        help="Whether a device that fails gets short probes, and the flaw that it resembles most "
        "is named.  [default: without --check]",
    ),
)


def judging_options(command: Wrapped) -> Wrapped:
    """Add the options of `Asked` but `--edition` and `--env` to ``command``."""
    for option in reversed(OPTIONS):
        command = option(command)
    return command


@dataclass(frozen=True)
class Asked:
    """What the user asked for, by the names of the options."""

    spec: str
    device_class: str | None
    effort: str
    ids: tuple[str, ...]
    seed: int
    waive: Path | None
    device_timeout: float | None
    resemblance: bool | None
    edition: str
    variables: tuple[str, ...]


def make_plan(
    asked: Asked,
    registry: Registry,
    device: Device,
    kept: Sequence[KeptCase] = (),
    report: Path | None = None,
) -> Plan:
    """Return the plan that judges ``device`` as ``asked``.

    Raises InputError for what cannot be used, or if the package that searches is missing.
    """
    checks, left_out = registry.select(asked.ids)
    waivers = {} if asked.waive is None else read_waivers(asked.waive, registry.checks)
    limit_time(device, asked.device_timeout)
    pass_variables(device, asked.variables)
    tell_where_truth_is(device)
    plan = Plan(
        asked.spec,
        device,
        checks,
        left_out,
        class_of(device, asked.device_class),
        asked.seed,
        Effort(asked.effort),
        tuple(kept),
        searching=getattr(device, "searchable", True),
        ahead=True,
        waivers=waivers,
        timeout_s=asked.device_timeout,
        variables=asked.variables,
        report=report,
        edition=find_edition(asked.edition),
        streams=StreamPlan.of(asked.ids),
    )
    if plan.searching:
        check_installed()
    return plan


def completing(asked: Asked, device: Device) -> Callable[[RunResult], RunResult]:
    """Return what adds the flaws that ``device`` resembles to a result, if they are ``asked`` for.

    Who asks for some checks alone repeats them often, and does without unless he asks for it.
    """
    wanted = not asked.ids if asked.resemblance is None else asked.resemblance
    return partial(add_resemblance, device=device) if wanted else lambda result: result
