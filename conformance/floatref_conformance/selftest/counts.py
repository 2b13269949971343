"""The results of the self-test: kills, unique killers, limits, false alarms."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.classes import DeviceClass
from floatref_conformance.editions.edition import Edition
from floatref_conformance.registry import Registry
from floatref_conformance.selftest.grading import ALLOWED, TOO_MUCH, Limit
from floatref_conformance.selftest.stream_tries import StreamCounts
from floatref_conformance.selftest.trying import Try, TryResult

Killers = Mapping[str, tuple[str, ...]]
"""The checks that each device must fail, by its SPEC."""


def find_killers(registry: Registry) -> Killers:
    """Return every device of ``registry`` that must fail checks, with these checks.

    Mutants of streams are not among them: they make sound profiles of recordings.
    """
    return {
        f"{kind.prefix}:{entry.name}": entry.fails
        for kind in registry.kinds.values()
        for entry in kind.entries()
        if entry.fails and not set(entry.fails) <= set(STREAM_CHECKS)
    }


def list_named_tries(
    killers: Killers, ids: Sequence[str], seeds: Iterable[int], edition: Edition
) -> tuple[Try, ...]:
    """Return every device on each check of ``ids`` that must fail it, with every seed."""
    return tuple(
        Try(spec, id_, seed, edition=edition.name)
        for seed in seeds
        for id_ in ids
        for spec, fails in killers.items()
        if id_ in fails
    )


def list_other_tries(
    killers: Killers, ids: Sequence[str], seeds: Iterable[int], edition: Edition
) -> tuple[Try, ...]:
    """Return every device that must fail only one check, on all other checks of ``ids``."""
    return tuple(
        Try(spec, id_, seed, edition=edition.name)
        for seed in seeds
        for id_ in ids
        for spec, fails in killers.items()
        if len(fails) == 1 and id_ not in fails
    )


def list_claim_tries(ids: Sequence[str], seeds: Iterable[int], edition: Edition) -> tuple[Try, ...]:
    """Return every built-in device on each check of ``ids`` whose class ``edition`` says it has."""
    return tuple(
        Try(f"builtin:{name}", id_, seed, DeviceClass(device_class), edition.name)
        for seed in seeds
        for id_ in ids
        for name, by_check in edition.document["reached"].items()
        for device_class in (by_check.get(id_, by_check.get("all")),)
        if device_class
    )


@dataclass(frozen=True)
class Counts:
    """The results of the self-test.

    Attributes:
        killers: the checks that each device must fail.
        ids: the checks that were run.
        kills: results of devices on the checks that they name.
        others: results of devices that name one check, on the others; empty if not requested.
        alarms: results of built-in devices on the classes that they claim.
        limits: the graded limits.
        ungraded: limits without a graded error.
        streams: what became of the checks of streams.
    """

    killers: Killers
    ids: tuple[str, ...]
    kills: tuple[TryResult, ...] = ()
    others: tuple[TryResult, ...] = ()
    alarms: tuple[TryResult, ...] = ()
    limits: tuple[Limit, ...] = ()
    ungraded: tuple[str, ...] = field(default=())
    streams: StreamCounts = field(default_factory=StreamCounts)

    @property
    def survivors(self) -> tuple[Try, ...]:
        """The devices that passed a check that must fail them."""
        return tuple(one.tried for one in self.kills if not one.fails)

    @property
    def false_alarms(self) -> tuple[TryResult, ...]:
        """The built-in devices that failed the class that they claim."""
        return tuple(one for one in self.alarms if one.fails)

    @property
    def broken(self) -> tuple[Limit, ...]:
        """The limits with a fault on either side."""
        return tuple(limit for limit in self.limits if limit.faults)

    def only_killed_by(self, id_: str) -> tuple[str, ...]:
        """Return the devices that check ``id_`` fails with every seed, and no other check does."""
        seen = {one.tried.spec for one in self.others if not one.fails}
        seen -= {one.tried.spec for one in self.others if one.fails}
        alive = {one.spec for one in self.survivors}
        return tuple(
            s for s, fails in self.killers.items() if fails == (id_,) and s in seen - alive
        )

    @property
    def without_unique_killer(self) -> tuple[str, ...]:
        """The checks that are not the only killer of any device, if that was requested."""
        return tuple(i for i in self.ids if self.others and not self.only_killed_by(i))

    @property
    def complaints(self) -> tuple[str, ...]:
        """All faults, one line each; empty if the suite holds."""
        lines = [f"{t.spec} passes {t.check} with seed {t.seed}" for t in self.survivors]
        lines += [f"{id_} is not the only killer of a device" for id_ in self.without_unique_killer]
        lines += [
            f"{limit.check}: {limit.quantity}, class {limit.device_class}: {fault}"
            for limit in self.broken
            for fault in limit.faults
        ]
        lines += [f"no graded error of {limit}" for limit in self.ungraded]
        lines += [
            f"{o.tried.spec} fails {o.tried.check} with seed {o.tried.seed}: {o.fails}"
            for o in self.false_alarms
        ]
        return (*lines, *self.streams.complaints)

    def to_dict(self) -> dict[str, Any]:
        """Return all counts as a JSON object."""
        return {
            "holds": not self.complaints,
            "mutants": len(self.killers),
            "kills": len(self.kills) - len(self.survivors),
            "kills_asked": len(self.kills),
            "only_killer_of": {i: self.only_killed_by(i) for i in self.ids if self.others},
            "limits": len(self.limits) - len(self.broken),
            "limits_asked": len(self.limits) + len(self.ungraded),
            "limit_factors": [TOO_MUCH, ALLOWED],
            "false_alarms": len(self.false_alarms),
            "alarms_asked": len(self.alarms),
            **({"streams": self.streams.to_dict()} if self.streams.failed else {}),
            "complaints": list(self.complaints),
        }
