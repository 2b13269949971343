"""What the options of `certify` mean: a plan, limits, and how recordings are processed."""

import re
from collections.abc import Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from floatref.errors import InputError
from floatref_conformance.certify.judging.limits import (
    LIMITED,
    CertificationLimits,
    change_limits,
    limits_of,
)
from floatref_conformance.certify.plan.plan_document import (
    Plan,
    SectionPlan,
    StationaryPlan,
    Stretch,
    read_plan,
    stretch_of,
)
from floatref_conformance.certify.plan.run_paths import check_exists, names_of, runs_of
from floatref_conformance.certify.practice.practice_document import DEFAULT, find_practice
from floatref_conformance.classes import DeviceClass

if TYPE_CHECKING:
    NumberType = click.ParamType[float | str]
else:
    # It takes no type argument before click 8.4.
    NumberType = click.ParamType

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NAMED_STRETCH = re.compile(rf"({NUMBER}):({NUMBER})(?::(.+))?", re.DOTALL)
PART = re.compile(rf"(.+)@({NUMBER}):({NUMBER})", re.DOTALL)
NO_LIMIT = "none"
OPTIONS = {
    "runs": "--runs",
    "repeatability": "--min-repeatability",
    "accuracy": "--min-accuracy",
    "distance_percent": "--max-distance-error",
    "height_percent": "--max-height-error",
    "iri_bias_percent": "--max-iri-bias",
    "long_wave_percent": "--max-long-wave-error",
    "quiescent_m_per_km": "--max-quiescent",
    "bounce_m_per_km": "--max-bounce",
}
"""By quantity, the option that sets its limit."""


class Limit(NumberType):
    """A number from 0 to ``most``; with ``optional`` also `NO_LIMIT`."""

    name = "limit"

    def __init__(self, most: float = 1e6, optional: bool = False) -> None:
        """Store what is allowed."""
        self._most = most
        self._optional = optional

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float | str:
        """Return the number, or `NO_LIMIT` unchanged."""
        if self._optional and value == NO_LIMIT:
            return NO_LIMIT
        try:
            number = float(value)
        except ValueError:
            number = float("nan")
        if not (isfinite(number) and 0.0 <= number <= self._most):
            other = f", or {NO_LIMIT}" if self._optional else ""
            self.fail(f"{value!r} is no number from 0 to {self._most:g}{other}", param, ctx)
        return number


def limits_with(
    device_class: DeviceClass, given: dict[str, Any], practice: str = DEFAULT
) -> CertificationLimits:
    """Return the limits of ``device_class``, replaced by those ``given``; `NO_LIMIT` is None.

    The practice of the result names those that differ from its own as changed.
    Raises InputError for what is no ``practice``, and for a class that it does not have.
    """
    chosen = find_practice(practice)
    classes = {one.device_class for one in chosen.requirements}
    if device_class is not DeviceClass.NOMINAL and device_class.value not in classes:
        raise InputError(
            f"--class {device_class}: practice {chosen.name} has no limits for it; leave it out"
        )
    changes: dict[str, float | None] = {
        name: None if value == NO_LIMIT else value
        for name, value in given.items()
        if name in LIMITED and value is not None
    }
    return change_limits(limits_of(device_class, chosen), changes, OPTIONS)


def plan_of(
    runs: Sequence[str],
    reference: str | None,
    sections: Sequence[str],
    plan: Path | None,
    quiescent: str | None,
    bounce: str | None,
) -> Plan:
    """Return the plan in the file ``plan``, or that of the command line.

    Stationary tests of the command line come in place of the file's. Raises InputError for both,
    or neither, and for what cannot be found.
    """
    if plan is not None:
        if runs or reference is not None or sections:
            raise InputError("--plan: names runs, reference and sections; leave out the others")
        made = read_plan(plan)
    else:
        made = Plan(_sections(runs, reference, sections))
    tests = {"quiescent": quiescent, "bounce": bounce}
    given = {name: stationary_of(text, name) for name, text in tests.items() if text is not None}
    return replace(
        made,
        quiescent=given.get("quiescent", made.quiescent),
        bounce=given.get("bounce", made.bounce),
    )


def stationary_of(text: str, name: str) -> StationaryPlan:
    """Return the test that ``text``, SRC or SRC@FROM:TO, describes."""
    found = PART.fullmatch(text)
    if found is None or Path(text).exists():
        return StationaryPlan(check_exists(text))
    return StationaryPlan(check_exists(found[1]), _stretch(f"--{name} {text}", found[2], found[3]))


def _sections(
    runs: Sequence[str], reference: str | None, sections: Sequence[str]
) -> tuple[SectionPlan, ...]:
    if not runs:
        raise InputError("no RUN given; name profiles or recordings, or a --plan")
    if reference is None:
        raise InputError("no --reference given; name the reference profile, or a --plan")
    truth, found = check_exists(reference), runs_of(runs)
    if not sections:
        return (SectionPlan(names_of([truth])[0], truth, found),)
    parts = [_part(text) for text in sections]
    names = [name for name, _ in parts]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"--section: two are called {name}; give FROM:TO:NAME")
    return tuple(SectionPlan(name, truth, found, stretch) for name, stretch in parts)


def _part(text: str) -> tuple[str, Stretch]:
    """Return name and stretch of the section ``text``; without a name it has its numbers'."""
    found = NAMED_STRETCH.fullmatch(text)
    if found is None:
        raise InputError(f"--section {text}: expected FROM:TO or FROM:TO:NAME, in m")
    name = found[3] or f"{found[1]} to {found[2]} m"
    return name, _stretch(f"--section {text}", found[1], found[2])


def _stretch(where: str, start: str, end: str) -> Stretch:
    try:
        return stretch_of(float(start), float(end))
    except InputError as error:
        raise InputError(f"{where}: {error}") from error
