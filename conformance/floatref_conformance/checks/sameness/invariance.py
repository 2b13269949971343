"""`invariance`: irrelevant changes of a recording do not change the profile."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Bench, Taken
from floatref_conformance.checks.sameness import changed_drives
from floatref_conformance.checks.sameness.change import Change, check_equipped
from floatref_conformance.checks.sameness.changed_drives import (
    BEFORE_M,
    BEHIND_M,
    END_M,
    FREE_M,
    STOP,
)
from floatref_conformance.checks.sameness.changes import CHANGES, LATER, begins_later_m, change_of
from floatref_conformance.checks.sameness.differences import (
    LOSS_LIMITS,
    PLACE_LIMITS,
    RISE_LIMITS,
    RISE_PERCENT,
    ROUGHNESS_LIMITS,
    measure_differences,
    measure_rise,
)
from floatref_conformance.checks.scoring import Compared, compare, correlation
from floatref_conformance.checks.stretches import Stretches, verify_stretches
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort, Limits, write_limits
from floatref_conformance.devices.interface import NEEDS
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

TRUTH_LIMITS: Limits = dict(zip(DeviceClass, (0.08, 0.05, 0.02), strict=True))
"""Correlation loss with the truth, as at constant speed."""
FROM_M = 150.0
"""Begin in m of the scored stretch of the shorter recording: the high-pass and the car of the IRI
have settled there."""
RAN_IN_M = 110.0
"""Begin in m of the stretch before a stop that shows the road."""


DERIVATION = (
    "Every case is processed twice, changed in one respect and then as recorded: the first samples "
    "cut off, so that every block of the software begins elsewhere; a time stamp for each sample "
    "in place of a rate; a bias of up to 0.03 m/s² (3 mg) added to the vertical accelerometers; "
    "time stamps up to 1e6 s and distances up to 100 km from where they were, where single "
    "precision is coarse; another sampling rate; the road 0.4 to 2.7 times as high under ideal "
    "sensors, the result scaled back; twice the time at a standstill. Of a device that declares "
    "a receiver: its heights up to 3 km from where they were, a half to a quarter of its readings; "
    "an inertial unit: gyros at 125 to 400 Hz in place of 100, biases of up to 0.03 m/s² and "
    "0.03 °/s; both: a road that climbs and leans by up to 2 %, on which gravity is no longer "
    "along the body's axes; on steeper ones the heights that a laser sees, tilted with the body, "
    "are themselves not those along the vertical. Drives of constant speed "
    f"or throttle are compared from {FROM_M:g} m behind the later beginning to {END_M:g} m before "
    "the end: the initial values of the software differ, and have left the high-pass (105.91 m) "
    "and the car of the IRI by then. No difference may be more than a tenth of the class's limit "
    "at constant speed (0.92, 0.95, 0.98; 5, 3, 2 %), so that no change uses "
    "up the class's allowance; new noise at another rate is included. Samples at 2 "
    "kHz and 97 km/h are 13.5 mm apart, readings of the laser held at 3.24 kHz 8.3 mm: results "
    "may lie 20 mm apart, in class reference 10 mm. At a stop, the error of the IRI over the "
    "160.9 m around it may grow by 10 % of it: drift grows with the square of the time, or its "
    "cube, and has to be suppressed, not merely filtered. The noise of the longer recording is "
    "different, for which 5, 3 and 2 % of an IRI of 2 m/km are allowed."
)
"""How the pairs are made, and the reasons of the limits."""
FLOOR = (
    "The unchanged result has to agree with the truth, filtered alike, as at constant speed: a "
    "correlation of 0.92, 0.95 and 0.98 by class over the same stretch, or before the stop. A "
    "flat profile would be equally flat after every change."
)
"""What prevents a device from passing with the same profile for every recording."""


@dataclass(frozen=True)
class InvarianceCheck:
    """The device processes a recording and a changed one; both results are compared."""

    id: str = changed_drives.CHECK
    title: str = "what must not matter does not matter"
    clause: str = "derived: a tenth of the class's limits at constant speed; 10 % more at a stop"
    derivation: str = DERIVATION
    floor: str = FLOOR
    needs: frozenset[str] = frozenset()
    meets: frozenset[str] = frozenset(NEEDS)
    """The needs that the device meets; changes of sensors that it does not have are no cases."""
    edition: Edition = field(default_factory=find_edition)

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """The limits of the differences, of the rise at a stop, and of the floor."""
        rise = write_limits(RISE_LIMITS, "m/km")
        return {
            "correlation loss between both": write_limits(LOSS_LIMITS),
            "IRI difference of both": write_limits(ROUGHNESS_LIMITS, "%"),
            "displacement between both": write_limits(PLACE_LIMITS, "m"),
            "rise of the IRI error": {
                c: f"{RISE_PERCENT:g} % of it and {limit}" for c, limit in rise.items()
            },
            "correlation loss": write_limits(TRUTH_LIMITS),
        }

    @property
    def simplest(self) -> Case:
        """Constant speed, one wheel path, stored with time stamps in place of a rate."""
        scenario = changed_drives.drive("clock-storage", 0, self.edition, rate_hz=4000.0)
        return Case(self.id, scenario, {"change": "clock-storage"})

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return every change once, in a certification three times, each on another road."""
        cases = changed_drives.seeded_cases(seed, effort, self.edition)
        return tuple(c for c in cases if c.variation["change"] in self._changes)

    def strategy(self) -> "SearchStrategy[Case]":
        """Return any change of any drive."""
        return changed_drives.case_strategy(self.edition, self._changes)

    def fit(self, meets: Iterable[str]) -> "InvarianceCheck":
        """Return the check without changes whose needs are not among ``meets``."""
        return replace(self, meets=frozenset(meets))

    @property
    def _changes(self) -> tuple[str, ...]:
        return tuple(name for name, c in CHANGES.items() if c.needs <= self.meets)

    def list_scored(self, case: Case) -> Stretches:
        """Return the compared stretch; for a stop also the one that shows the road.

        Raises InputError for a variation without the number that gives the begin.
        """
        if case.variation.get("change") == STOP:
            stretches = (RAN_IN_M, FREE_M), _around_the_stop(case.scenario)
            return verify_stretches(stretches, drive_of(case.scenario).length_m)
        start_m = FROM_M
        if case.variation.get("change") == LATER:
            start_m += changed_drives.later_m(case.scenario, case.variation)
        length_m = drive_of(case.scenario).length_m
        return verify_stretches(((start_m, length_m - END_M),), length_m)

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Return the differences of both results, and the unchanged one's loss to the truth.

        The changed recording comes first: data that the device stores of it must serve both.
        Raises InputError for a variation without a change or without a number of it, for a
        change of sensors that the device does not have, and for a case that `list_scored` refuses.
        """
        change = change_of(case.variation)
        self.list_scored(case)
        before = bench.simulate(case.scenario)
        check_equipped(before.recording, change.needs, f"change {case.variation['change']}")
        after = _change(case, change, before, bench)
        undone = change.profile(bench.run(after, "changed"), case.variation)
        result = bench.run(before, "unchanged")
        if case.variation["change"] == STOP:
            pairs = zip(compare(before.truth, result), compare(after.truth, undone), strict=True)
            return tuple(m for one, other in pairs for m in _at_a_stop(one, other, case.scenario))
        start_m, end_m = FROM_M, before.truth.length_m - END_M
        if case.variation["change"] == LATER:
            start_m += begins_later_m(before.recording, after.recording)
        pairs = zip(compare(before.truth, result), compare(before.truth, undone), strict=True)
        return tuple(
            m
            for one, other in pairs
            for m in (
                *measure_differences(one, other, start_m, end_m),
                _measure_floor(one, start_m, end_m),
            )
        )


def _change(case: Case, change: Change, before: Taken, bench: Bench) -> Taken:
    """Return the changed recording; an unchanged drive is not simulated again."""
    scenario = change.scenario(case.scenario, case.variation)
    taken = before if scenario == case.scenario else bench.simulate(scenario)
    return replace(
        taken,
        recording=change.recording(taken.recording, case.variation),
        truth=change.truth(taken.truth, case.variation),
    )


def _measure_floor(compared: Compared, start_m: float, end_m: float) -> Measurement:
    return correlation(compared.whole(start_m, end_m), compared.track, TRUTH_LIMITS)


def _around_the_stop(scenario: Scenario) -> tuple[float, float]:
    return scenario.event_at_m - BEFORE_M, scenario.event_at_m + BEHIND_M


def _at_a_stop(before: Compared, after: Compared, scenario: Scenario) -> tuple[Measurement, ...]:
    stretch = _around_the_stop(scenario)
    return (
        measure_rise(before.whole(*stretch), after.whole(*stretch), before.track),
        _measure_floor(before, RAN_IN_M, FREE_M),
    )
