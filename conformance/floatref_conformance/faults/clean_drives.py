"""Healthy drives of the families: whatever the screening reports of them is a false alarm."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from itertools import islice

from floatref.errors import FloatrefError
from floatref.values.profile import Profile
from floatref_conformance.devices.builtin import process_with_warnings
from floatref_conformance.devices.interface import CAPABILITIES
from floatref_conformance.faults.study import PIPELINES
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.families.conditions import CONDITIONS
from floatref_conformance.table.families.family_settings import draw_drive
from floatref_conformance.worker_pool import map_in_order

LATENCY_MS = 0.5
"""Largest error of a latency in ms that is stated right: the least that is moved."""


@dataclass(frozen=True)
class Alarm:
    """What a pipeline reported of a healthy drive."""

    drive: str
    pipeline: str
    line: str
    refused: bool


@dataclass
class CleanDrives:
    """Healthy drives that were tried, and the false alarms."""

    drives: int = 0
    alarms: list[Alarm] = field(default_factory=list)

    @property
    def alarmed(self) -> int:
        """Number of drives with an alarm."""
        return len({alarm.drive for alarm in self.alarms})


def clean_scenarios(count: int, seed: int = 0) -> Iterator[tuple[str, Scenario]]:
    """Yield ``count`` drives by name: all conditions of the families in turn, drawn anew."""
    yield from islice(_scenarios(seed), count)


def _scenarios(seed: int) -> Iterator[tuple[str, Scenario]]:
    number = 0
    while True:
        for condition in CONDITIONS:
            name = f"{condition.full_name} {number + 1}"
            yield name, draw_drive(seed, condition, number, frozenset(CAPABILITIES))
        number += 1


def try_clean_drives(
    count: int,
    seed: int = 0,
    jobs: int = 1,
    pipelines: tuple[str, ...] = PIPELINES,
    watch: Callable[[str], None] | None = None,
) -> CleanDrives:
    """Return the false alarms of ``count`` healthy drives; ``watch`` is called after each."""
    made = CleanDrives()
    names, scenarios = zip(*clean_scenarios(count, seed), strict=True)
    with map_in_order(partial(try_drive, pipelines=pipelines), jobs, names, scenarios) as results:
        for name, alarms in zip(names, results, strict=True):
            made.drives += 1
            made.alarms += alarms
            if watch is not None:
                watch(name)
    return made


def try_drive(name: str, scenario: Scenario, pipelines: tuple[str, ...]) -> list[Alarm]:
    """Return the false alarms of every one of ``pipelines`` about a healthy ``scenario``.

    A latency that the drive has, and that the line states right, is no alarm.
    """
    from floatref_conformance.proving_ground.simulate import simulate

    recording, alarms = simulate(scenario).recording, []
    for pipeline in pipelines:
        try:
            profile, lines = process_with_warnings(recording, pipeline)
        except FloatrefError as refusal:
            alarms.append(Alarm(name, pipeline, str(refusal), True))
        else:
            true = _true_lateness(profile, scenario)
            false = [line for line in lines if not line.startswith(true)]
            alarms += [Alarm(name, pipeline, line, False) for line in false]
    return alarms


def _true_lateness(profile: Profile, scenario: Scenario) -> tuple[str, ...]:
    """Return how lines about heights begin that were moved by the latency of ``scenario``."""
    moved = {
        track: float(own["later_s"])
        for track, own in profile.provenance["laser"].items()
        if "later_s" in own
    }
    return tuple(
        f"channel {track}.height: {1e3 * later_s:.2f} ± "
        for track, later_s in moved.items()
        if abs(1e3 * later_s - scenario.latency_ms) <= LATENCY_MS
    )
