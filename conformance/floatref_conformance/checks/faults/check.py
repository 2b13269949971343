"""`faults`: around missing or damaged samples the profile is right or flagged."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving.rules import ELSEWHERE, rules_of
from floatref_conformance.checks.faults import faulty_drives
from floatref_conformance.checks.faults.fault_scores import (
    BASE_M,
    FLAGGED_LIMITS,
    LOCAL_LIMITS,
    ROUGHNESS,
    WHOLE_M,
    compare_everywhere,
    measure_fault,
)
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS, fault_of, needs_of
from floatref_conformance.checks.flags import END_LIMITS, EVENT_LIMITS, measure_flags
from floatref_conformance.checks.interface import Bench
from floatref_conformance.checks.sameness.change import check_equipped
from floatref_conformance.checks.scoring import Compared, compare
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort, Limits, write_limits
from floatref_conformance.devices.interface import HEIGHT, NEEDS
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

DERIVATION = (
    "A recording of two wheel paths is processed with one fault in it, and then as it is. The "
    "laser of the first path loses readings (one sample to 2 s, or up to 60 short drop-outs), "
    "sticks (0.1 to 1 s), or is pinned 50 mm beyond all that it measured (10 to 500 ms); its "
    "accelerometer loses samples (one to 1 s) or is driven to a full scale of 2, 4 or 5 g (2 to "
    "20 ms); all channels have a gap (50 ms to 1 s), of missing samples or of missing time; the "
    "encoder loses samples, leaps by 0.1 to 3 m, is silent and then correct again, loses counts "
    "permanently, has single readings that are too low, or rolls back by 20 to 500 mm at a stop. "
    "Of a device that declares them, a receiver loses its fix for 2 to 10 s, or for 8 to 30 s "
    "around a stop, is 0.3 to 3 m too high with a worse quality, wanders by up to 1 m without "
    "fixed ambiguities, jumps permanently by 0.3 to 3 m without a sign, repeats one height for 2 "
    "to 10 s on a slope, or is never fixed at all; an inertial unit loses its rates for up to 1 s "
    "while the vehicle brakes for a stop, or up to 60 single samples; of the sensors of a "
    "vehicle's response the wheel's accelerometer loses samples (one to 1 s), sticks (0.1 to 1 s) "
    "or is driven to a full scale of 8, 10 or 16 g (2 to 20 ms), the body's loses samples, and "
    "the deflection of the suspension is missing or sticks. A laser's faults are no cases of a "
    "device without one. "
    "Every case has a road of its own. "
    "Each is common in the field: an error in place of a profile is a failure. Metres that the "
    "encoder counted too many or too few are removed from the axis before the comparison. "
    "Right: over all points that the device marks valid, the IRI is off by no more than 5 % or "
    "0.1 m/km, in the stricter classes 3 and 2 % as at constant speed. And on average over any "
    f"{BASE_M:g} m (25 ft) the output of the IRI's filter differs from that without the fault "
    f"by no more than if an error of 0.1 m/km (0.06, 0.04) in the IRI of {WHOLE_M:g} m lay "
    "only within them; flagged points get the truth's "
    "shape. Or flagged, beyond the distance travelled while the fault lasted: a laser's reading "
    "is subtracted, never integrated, so its fault remains local, within the 10 m (5 m) "
    "that stricter classes may flag at an event. An accelerometer's is integrated twice and "
    "spread to either side by the high-pass (105.91 m): each side may have the length of an "
    "event, 125 m; class adequate has half a cut-off wavelength on each side, reference a "
    "quarter; the same for gaps, inertial units, receivers and the sensors of a response. For a "
    "receiver that jumps or is never fixed no more than that may be flagged: a profiler without "
    "one measures the road as well. An encoder's fault looks like an event, and has its limits."
)
"""The faults in the recordings, and the reasons of the limits."""
FLOOR = (
    "Without the fault, the device may flag no more than at the ends of any run and around a "
    "stop. Where it does not stop, it may flag 10 m (class reference 5 m) between "
    "the ends, as at constant speed. The remaining points have the "
    "roughness of the road within the limits above, so that neither a flat profile nor one that "
    "is flagged everywhere passes."
)
"""What prevents a device from passing with a profile that is flat or flagged."""


@dataclass(frozen=True)
class FaultsCheck:
    """Compares the profiles of a recording with a fault and without it to the truth."""

    id: str = faulty_drives.CHECK
    title: str = "missing and damaged samples are flagged and stay local"
    clause: str = "derived: right or flagged; the high-pass' reach; the limits of an event"
    derivation: str = DERIVATION
    floor: str = FLOOR
    needs: frozenset[str] = frozenset()
    meets: frozenset[str] = frozenset(NEEDS)
    """The needs that the device meets; faults of sensors that it does not have are no cases."""
    edition: Edition = field(default_factory=find_edition)

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """The limits of unflagged points, and of flagged lengths."""
        either = {c: f"{share:g} % or {least:g} m/km" for c, (share, least) in ROUGHNESS.items()}
        return {
            "IRI error, unflagged": either,
            "local error, unflagged": write_limits(LOCAL_LIMITS, "m/km"),
            **{
                f"flagged beyond a fault: {part}": write_limits(limits, "m")
                for part, limits in FLAGGED_LIMITS.items()
            },
            "flagged at an end": write_limits(END_LIMITS, "m"),
            "flagged around an event": write_limits(EVENT_LIMITS, "m"),
            ELSEWHERE: write_limits(self._unprovoked, "m"),
        }

    @property
    def simplest(self) -> Case:
        """Half a second without laser, or without wheel accelerometer, at constant speed."""
        scenario = faulty_drives.make_drive(self.edition, rate_hz=4000.0)
        fault = "laser-dropout" if HEIGHT in self.meets else "response-wheel-dropout"
        return Case(self.id, scenario, {"fault": fault, "at_m": 280.0, "length_s": 0.5})

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return every fault once, in a certification three times; ``seed`` draws the roads."""
        cases = faulty_drives.seeded_cases(seed, effort, self.edition)
        return tuple(c for c in cases if c.variation["fault"] in self._faults)

    def strategy(self) -> "SearchStrategy[Case]":
        """Return any fault of any length, size and place in any drive."""
        return faulty_drives.case_strategy(self.edition, self._faults)

    def fit(self, meets: Iterable[str]) -> "FaultsCheck":
        """Return the check without the faults of sensors that are not among ``meets``."""
        return replace(self, meets=frozenset(meets))

    @property
    def _faults(self) -> tuple[str, ...]:
        return tuple(f for f in SENSOR_FAULTS if needs_of(f) <= self.meets)

    def list_scored(self, case: Case) -> Stretches:
        """Return the whole drive: every point counts that the device marks valid."""
        return ((0.0, case.scenario.length_m),)

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Return the effect of the fault on every wheel path, and the flags without it.

        The device gets the fault first, so that it cannot have stored the road before.
        Raises InputError for a variation without a fault or without a number of it, and for the
        fault of a sensor that the device does not have.
        """
        taken = bench.simulate(case.scenario)
        inject, fault = fault_of(case.variation), str(case.variation["fault"])
        check_equipped(taken.recording, needs_of(fault), f"fault {fault}")
        faulty = inject(taken.recording, case.variation)
        changed = replace(taken, recording=faulty.recording, healthy=False)
        after = bench.run(changed, "with the fault")
        before = bench.run(taken, "without the fault")
        part = fault.partition("-")[0]
        alike = (
            compare_everywhere(taken.truth, before),
            compare_everywhere(taken.truth, after, faulty),
        )
        # A distance that the encoder never had is on no device's axis: it is not flagged.
        delivered = compare(taken.truth, before)
        return tuple(
            m
            for one, other, whole in zip(*alike, delivered, strict=True)
            for m in (
                *measure_fault(one, other, faulty, part),
                *self._measure_flags_without_fault(whole, case.scenario),
            )
        )

    @property
    def _unprovoked(self) -> Limits:
        """Longest flagged length in m away from the ends, where no event lies."""
        return rules_of(self.edition)["constant"].flagged_elsewhere

    def _measure_flags_without_fault(
        self, whole: Compared, scenario: Scenario
    ) -> tuple[Measurement, ...]:
        """Return the flagged lengths of a drive without a fault; a steady one has no event."""
        if scenario.manoeuvre == "stop":
            return measure_flags(whole, scenario, (scenario.event_at_m,))
        ends, elsewhere = measure_flags(whole, scenario, ())
        return ends, replace(elsewhere, quantity=ELSEWHERE, limits=self._unprovoked)
