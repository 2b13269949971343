"""The checks of streams under test: mutants on all five checks, and sound devices on them."""

from collections.abc import Mapping, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass, field
from typing import Any

from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.events import Event
from floatref_conformance.judge.exercise import close, describe
from floatref_conformance.judge.stream_judging import StreamTrial, find_live_argv
from floatref_conformance.mutants.in_streams import STREAM_MUTANTS
from floatref_conformance.plugins import load_registry
from floatref_conformance.worker_pool import worker_pool

SOUND = ("builtin:road-prior-smoother", "builtin:temporal-matched-hpf")
"""Devices that no check of streams may fail."""


@dataclass(frozen=True)
class StreamTry:
    """A device by its SPEC on checks of streams with one seed, whose runs are shared."""

    spec: str
    seed: int
    checks: tuple[str, ...]


@dataclass(frozen=True)
class StreamCounts:
    """What became of mutants and sound devices.

    Attributes:
        ids: the checks that were tried.
        failed: by device and seed, the checks that failed it, each with the reason.
    """

    ids: tuple[str, ...] = ()
    failed: Mapping[StreamTry, Mapping[str, str]] = field(default_factory=dict)

    @property
    def complaints(self) -> tuple[str, ...]:
        """All faults, one line each; empty if the checks of streams hold."""
        must = {f"mutant:{mutant.name}": mutant.fails for mutant in STREAM_MUTANTS}
        lines = []
        for tried, failed in self.failed.items():
            for id_ in tried.checks:
                where = f"{tried.spec} {{}} {id_} with seed {tried.seed}"
                if id_ in must.get(tried.spec, ()) and id_ not in failed:
                    lines.append(where.format("passes"))
                elif id_ not in must.get(tried.spec, ()) and id_ in failed:
                    lines.append(f"{where.format('fails')}: {failed[id_]}")
        return tuple(lines)

    def to_dict(self) -> dict[str, Any]:
        """Return the counts as a JSON object."""
        sound = [tried for tried in self.failed if tried.spec in SOUND]
        mutants = [tried for tried in self.failed if tried.spec not in SOUND]
        return {
            "mutants": len({tried.spec for tried in mutants}),
            "kills": sum(bool(self.failed[tried]) for tried in mutants),
            "kills_asked": len(mutants),
            "false_alarms": sum(len(self.failed[tried]) for tried in sound),
            "alarms_asked": sum(len(tried.checks) for tried in sound),
        }

    @property
    def lines(self) -> tuple[str, ...]:
        """The counts in words; empty if no check of streams was tried."""
        if not self.failed:
            return ()
        n = self.to_dict()
        return (
            f"Streams: {n['kills']} of {n['kills_asked']} times a mutant was killed by a check of "
            f"streams; {n['false_alarms']} false alarms in {n['alarms_asked']} checks",
        )


def list_stream_tries(
    ids: Sequence[str], seeds: int, false_alarms: int, unique: bool
) -> tuple[StreamTry, ...]:
    """Return every mutant on the checks of ``ids`` that must fail it, and sound devices on all.

    With ``unique`` mutants are tried on all, too. Seeds are counted from 0: ``seeds`` of them for
    mutants, ``false_alarms`` for sound devices.
    """
    wanted = tuple(id_ for id_ in STREAM_CHECKS if id_ in ids)
    tries = [
        StreamTry(f"mutant:{mutant.name}", seed, tuple(asked))
        for seed in range(seeds)
        for mutant in STREAM_MUTANTS
        if (asked := [id_ for id_ in wanted if unique or id_ in mutant.fails])
    ]
    sound = [StreamTry(spec, seed, wanted) for seed in range(false_alarms) for spec in SOUND]
    return (*tries, *(sound if wanted else ()))


def try_streams(tries: Sequence[StreamTry], processes: int) -> StreamCounts:
    """Return what became of ``tries``; an error of the suite is raised."""
    ids = tuple(dict.fromkeys(id_ for tried in tries for id_ in tried.checks))
    if processes < 2 or len(tries) < 2:
        return StreamCounts(ids, {tried: attempt_stream(tried) for tried in tries})
    with worker_pool(processes) as pool:
        coming = {pool.submit(attempt_stream, tried): tried for tried in tries}
        return StreamCounts(ids, {coming[done]: done.result() for done in as_completed(coming)})


def attempt_stream(tried: StreamTry) -> Mapping[str, str]:
    """Return the checks of ``tried`` that fail its device, each with the reason."""
    device = load_registry().device(tried.spec)
    try:
        argv = find_live_argv(device)
        if argv is None:
            raise SuiteError(f"{tried.spec} does not stream")
        about, level = describe(device), DeviceClass.NOMINAL
        trial = StreamTrial(about, level, tried.seed, Effort.QUICK, _ignore)
        results = [trial.judge(STREAM_CHECKS[id_], argv) for id_ in tried.checks]
    finally:
        close(device)
    bad = (Outcome.FAIL, Outcome.ERROR)
    return {result.id: result.reason for result in results if result.outcome in bad}


def _ignore(event: Event) -> None:
    """Ignore ``event``."""
