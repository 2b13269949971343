"""What happens during a run, one value after another; renderers turn them into output."""

from dataclasses import dataclass
from typing import Protocol

from floatref_conformance.checks.catalogue import LeftOut
from floatref_conformance.checks.interface import Check
from floatref_conformance.devices.interface import Description
from floatref_conformance.verdict import CaseResult, CheckResult, RunResult


@dataclass(frozen=True)
class RunStarted:
    """The run begins; nothing is said of the checks ``left_out``."""

    spec: str
    description: Description
    checks: tuple[Check, ...]
    left_out: tuple[LeftOut, ...]


@dataclass(frozen=True)
class CheckStarted:
    """A check begins; it has ``cases`` cases."""

    id: str
    cases: int


@dataclass(frozen=True)
class CaseFinished:
    """One case of check ``id`` has been judged."""

    id: str
    result: CaseResult


@dataclass(frozen=True)
class CheckFinished:
    """A check has its outcome."""

    result: CheckResult


@dataclass(frozen=True)
class RunFinished:
    """The verdict is there."""

    result: RunResult


Event = RunStarted | CheckStarted | CaseFinished | CheckFinished | RunFinished


class Renderer(Protocol):
    """Turns the events of a run into one form of output."""

    def handle(self, event: Event) -> None:
        """Take note of ``event``; write what it brings."""
