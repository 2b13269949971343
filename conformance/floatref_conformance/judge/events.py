"""The events of a run, one value each; renderers turn them into output."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from floatref_conformance.checks.catalogue import LeftOut
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.verdict import CaseResult, CheckResult, RunResult
from floatref_conformance.devices.interface import Description


@dataclass(frozen=True)
class RunStarted:
    """The run begins; there are no more events of the checks ``left_out``."""

    spec: str
    description: Description
    checks: tuple[Check, ...]
    left_out: tuple[LeftOut, ...]


@dataclass(frozen=True)
class CheckStarted:
    """A check begins; it has ``cases`` seeded cases."""

    id: str
    cases: int


@dataclass(frozen=True)
class CaseFinished:
    """One case of check ``id`` has been judged: seeded, drawn by the search, or simplified."""

    id: str
    result: CaseResult


@dataclass(frozen=True)
class SearchStarted:
    """The seeded cases of check ``id`` are done; the search tries up to ``cases`` more."""

    id: str
    cases: int


@dataclass(frozen=True)
class ShrinkStarted:
    """A case of check ``id`` fails; up to ``cases`` cases are tried to simplify it."""

    id: str
    cases: int


@dataclass(frozen=True)
class CaseReplayed:
    """A case stored by an earlier run has been judged."""

    replayed: Mapping[str, Any]


@dataclass(frozen=True)
class CheckFinished:
    """A check has its outcome."""

    result: CheckResult


@dataclass(frozen=True)
class RunFinished:
    """The run has its verdict."""

    result: RunResult


Event = (
    RunStarted
    | CheckStarted
    | SearchStarted
    | ShrinkStarted
    | CaseFinished
    | CaseReplayed
    | CheckFinished
    | RunFinished
)


Emit = Callable[[Event], None]
"""Is called with every event of a run."""


class Renderer(Protocol):
    """Turns the events of a run into one form of output."""

    def handle(self, event: Event) -> None:
        """Record ``event`` and write its output."""
