"""Flaws of the protocol and of streams, by the faults that a run itself has met."""

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from floatref_conformance.checks.likeness import Likeness
from floatref_conformance.checks.verdict import CheckResult, Outcome
from floatref_conformance.mutants.flaws import list_flaws
from floatref_conformance.mutants.in_streams import STREAM_MUTANTS

REASONS: Mapping[str, str] = {
    "exit-at-start": r"(^|: )start: (exited with status|was killed by|closed its)",
    "hang": r"(^|: )run: no answer within",
    "crash": r"(^|: )run: (exited with status|was killed by|closed its)",
    "flood": r"(^|: )run: wrote (a line longer|more) than",
    "garbage": r"(^|: )run: the answer is not (UTF-8|JSON|a JSON object): (?!.*\b(NaN|Infinity)\b)",
    "out-of-order": r"(^|: )run: answered (seq|without a seq)",
    "nan-answer": r"(^|: )run: the answer is not JSON: .*\b(NaN|Infinity)\b",
    "nothing-delivered": r"(^|: )delivered no profile directory",
    "delivered-elsewhere": r"(^|: )delivered a symbolic link|which is a symbolic link",
}
"""What the judge writes of each fault of the protocol, by the mutant that has it."""


class Judged(NamedTuple):
    """What a report says of a check: its id, its outcome, and why it did not pass."""

    id: str
    outcome: Outcome
    reason: str

    @classmethod
    def of(cls, check: CheckResult) -> "Judged":
        """Return the part of ``check`` that shows faults."""
        return cls(check.id, check.outcome, check.reason)


def name_protocol_flaws(checks: Iterable[Judged]) -> tuple[Likeness, ...]:
    """Return the flaws whose faults of the protocol made ``checks`` errors, most frequent first."""
    return _count(
        mutant
        for check in checks
        if check.outcome is Outcome.ERROR
        for mutant, text in REASONS.items()
        if re.search(text, check.reason)
    )


def name_stream_flaws(streams: Iterable[Judged]) -> tuple[Likeness, ...]:
    """Return the flaws of streams whose checks fail, each of which is that of one mutant."""
    return _count(
        mutant.name
        for check in streams
        if check.outcome in (Outcome.FAIL, Outcome.ERROR)
        for mutant in STREAM_MUTANTS
        if check.id in mutant.fails
    )


def _count(mutants: Iterator[str]) -> tuple[Likeness, ...]:
    counts: dict[str, int] = {}
    for mutant in mutants:
        counts[mutant] = counts.get(mutant, 0) + 1
    names = {flaw.mutant: flaw.name for flaw in list_flaws()}
    ranked = sorted(counts, key=lambda mutant: -counts[mutant])
    return tuple(Likeness(mutant, names[mutant], 1.0) for mutant in ranked)
