"""`distance`: features lie at the encoder's distance, even with scale errors, slip and stops."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import cycle
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.distance.features import (
    BESIDE_EVENT_M,
    END_M,
    FARTHEST_M,
    FEATURE_M,
    Feature,
    event_of,
    feature_stretches,
    find_features,
    middles,
    place,
    scenario_of,
)
from floatref_conformance.checks.encoder_axis import EncoderAxis
from floatref_conformance.checks.interface import Bench, Taken
from floatref_conformance.checks.rounded import rounded_numbers, seeds
from floatref_conformance.checks.stretches import Stretches, verify_stretches
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort, Limits, same_limit, write_limits
from floatref_conformance.editions.edition import Edition, Table, find_edition
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.staging import drive_of

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

START_LIMITS: Limits = same_limit(0.05, 0.025)
SCALE_LIMITS: Limits = same_limit(0.15, 0.05)
STEP_LIMITS: Limits = same_limit(0.05, 0.025)
REST_LIMITS: Limits = same_limit(0.05, 0.025)
LOSS_LIMITS: Limits = {
    DeviceClass.NOMINAL: 0.2,
    DeviceClass.ADEQUATE: 0.1,
    DeviceClass.REFERENCE: 0.05,
}
QUANTITIES = (
    ("displacement of the start", "m", START_LIMITS),
    ("error of distances", "%", SCALE_LIMITS),
    ("step at the event", "m", STEP_LIMITS),
    ("displacement of a feature", "m", REST_LIMITS),
    ("loss of a feature", "", LOSS_LIMITS),
)
"""What is measured, its unit, and its limits."""
SMOOTHEST, ROUGHEST = 1.5, 4.0
"""IRI of the roads, in m/km."""
VEHICLES = ("loaded-van", "minivan", "pickup", "trailer")
COUNT: Mapping[Effort, int] = {Effort.QUICK: 4, Effort.CERTIFICATION: 16}


DERIVATION = (
    f"Features are stretches of {FEATURE_M:g} m of a rough road, {END_M:g} m or more from both "
    f"ends of the run and {BESIDE_EVENT_M:g} m from a stop or a release of the brake, so that no "
    "event moves them. The truth is converted to the encoder's axis: for every sample the drive "
    "gives the true distance, and the recording the encoder's reading. The encoder is up to 1 % "
    "wrong, slips by up to {most_slip:g} % per g, which from 48 to 24 km/h loses {lost_m:.2f} m "
    "(section 3.3.9 saw 0.8 m), and does not count at stops; {better}. A device "
    "without a height sensor measures the road at a wheel, up to 5.07 m ahead of the place of a "
    "laser; it adds this length to the encoder's reading, and its truth is converted in the same "
    "way: 1 % of the length, 51 mm, is an error of the encoder that it cannot know. "
    "Slopes in the waveband of 1.6 to 8 m are cross-correlated with those of the truth "
    f"at lags of up to {FARTHEST_M:g} m. A line through the lags, with a step at the event, gives "
    "the four displacements. Start, step and rest: delays turn into distance. At 90 km/h the "
    "anti-alias filter of 1000 Hz (2/ω, 0.32 ms) is worth 8 mm, the mean age of a laser reading "
    "held at 3.24 kHz (0.155 ms) 4 mm, a sample at 16 kHz 1.6 mm, an interval of the profile 5 mm, "
    "a count 0.3 mm, and the lags come in steps of an interval: together 24 mm; less in "
    "the slower half of a drive. Nominal and adequate allow twice that, 0.05 m, and "
    "reference 0.025 m. Distances: with 0.15 % the ends of 160.9 m lie 0.12 m off when the middle "
    "fits, a phase of 20 degrees at 2.1 m, where the car of the IRI has its axle hop at 80 km/h; "
    "0.36²/6 of the correlation, 0.02, is lost, all that class reference may lose. Class "
    "reference is allowed a third. A profile that does not cover the recorded distance is refused."
)
"""How features are found, and where the limits come from; an edition completes it."""
BETTER = {
    False: "a device with a better sensor must use this axis too",
    True: "a device with a better sensor may use the true distance instead, and the axis that its "
    "features lie nearer counts",
}
"""What `Edition.true_axis` means for a device."""
FLOOR = (
    "Every feature has to be found: its correlation with the truth, by (2.16) and so by its "
    "height as well, may fall short of 1 by 0.2 in class nominal, 0.1 in adequate, 0.05 in "
    "reference. Lags, noise and slip cost sound software 0.01. A flat profile loses 1; a moving "
    "average over 2 m takes all of the waves of 2 m and a tenth of those of 8 m."
)
"""What the profile must contain."""


@dataclass(frozen=True)
class DistanceCheck:
    """Searches for features of the road on the encoder's axis."""

    id: str = "distance"
    title: str = "features lie at the distance of the encoder"
    clause: str = (
        "Derived: the encoder's distance is the profile's axis (Karamihas 2021, sections 3.3.9, "
        "4.1.3 and 5.1); limits from the sensors' delays and the loss of correlation"
    )
    floor: str = FLOOR
    needs: frozenset[str] = frozenset()
    edition: Edition = field(default_factory=find_edition)

    @property
    def derivation(self) -> str:
        """How features are found, by what encoder, and where the limits come from."""
        most = self.edition.encoder["slip_percent_per_g"].high
        lost_m = most / 100 * (48**2 - 24**2) * KMH**2 / (2 * STANDARD_GRAVITY)
        better = BETTER[self.edition.true_axis]
        return DERIVATION.format(most_slip=most, lost_m=lost_m, better=better)

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """The limits of the five quantities."""
        return {name: write_limits(limits, unit) for name, unit, limits in QUANTITIES}

    @property
    def simplest(self) -> Case:
        """One stop from 72 km/h; the encoder's errors are those of the nominal sensor."""
        return Case(self.id, scenario_of({"manoeuvre": "stop"}, self.edition))

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the cases: drives and vehicles in turn; roads and noise are drawn."""
        source = np.random.SeedSequence([seed, *self.id.encode()])
        roads = source.generate_state(COUNT[effort])
        return tuple(
            self._make_case(number, int(road), drive)
            for number, (road, drive) in enumerate(zip(roads, cycle(self._drives), strict=False))
        )

    def strategy(self) -> "SearchStrategy[Case]":
        """Return any of the manoeuvres with any error of the encoder up to the largest."""
        from hypothesis import strategies as st

        shared = {
            "seed": seeds(),
            "vehicle": st.sampled_from(VEHICLES),
            "iri_m_per_km": rounded_numbers(SMOOTHEST, ROUGHEST),
            "speed_kmh": rounded_numbers(40, 90, 0),
            **{name: drawn.strategy() for name, drawn in self.edition.encoder.items()},
        }
        slowing = {"deceleration_g": rounded_numbers(0.1, 0.4, 2)}
        after = {
            "dwell_s": rounded_numbers(0.5, 20.0),
            "final_speed_kmh": rounded_numbers(30, 70, 0),
        }
        release = {"event_speed_kmh": rounded_numbers(20, 30, 0)}
        drives = (
            {"manoeuvre": st.just("constant"), **shared},
            {"manoeuvre": st.just("stop"), **shared, **slowing, **after},
            {"manoeuvre": st.just("braking"), **shared, **slowing, **release},
        )
        numbers = st.one_of([st.fixed_dictionaries(drive) for drive in drives])
        return numbers.map(lambda given: Case(self.id, scenario_of(given, self.edition)))

    def list_scored(self, case: Case) -> Stretches:
        """Return the stretches in which features lie, ahead of an event and behind it.

        Raises InputError for a drive that is too short for them.
        """
        length_m = drive_of(case.scenario).length_m
        return verify_stretches(feature_stretches(length_m, event_of(case.scenario)), length_m)

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Return the displacements of the features of every wheel path.

        Raises InputError for what `list_scored` refuses, DeviceError for a point without elevation
        in one of them.
        """
        self.list_scored(case)
        taken = bench.simulate(case.scenario)
        profile = bench.run(taken)
        found = [_measure_along(axis, taken, profile) for axis in self._list_axes(taken)]
        return min(found, key=_worst_ratio)

    @property
    def _drives(self) -> Sequence[Table]:
        """The drives of the cases, in turn."""
        drives: Sequence[Table] = self.edition.document["distance"]
        return drives

    def _list_axes(self, taken: Taken) -> tuple[EncoderAxis, ...]:
        """Return the axes along which features may lie."""
        axis = EncoderAxis.of(taken)
        return (axis, EncoderAxis.without_error(taken)) if self.edition.true_axis else (axis,)

    def _make_case(self, number: int, road: int, drive: Mapping[str, Any]) -> Case:
        roughness = np.random.default_rng(road).uniform(SMOOTHEST, ROUGHEST)
        numbers = {
            **drive,
            "seed": road,
            "iri_m_per_km": round(roughness, 1),
            "vehicle": VEHICLES[(number + number // len(self._drives)) % len(VEHICLES)],
        }
        case = scenario_of(numbers, self.edition)
        return Case(self.id, case, name=f"{self.id}-{number + 1}")


def _measure_along(axis: EncoderAxis, taken: Taken, profile: Profile) -> tuple[Measurement, ...]:
    """Return the displacements of the features of every wheel path along ``axis``."""
    true_event_m = event_of(taken.scenario)
    at = middles(drive_of(taken.scenario).length_m, true_event_m)
    event_m = None
    if true_event_m is not None:
        event_m = float(axis.to_encoder(np.array([true_event_m]))[0])
    measured: list[Measurement] = []
    for track in taken.truth.tracks:
        features = find_features(profile, taken.truth, track.name, axis, at)
        measured += _measure(track.name, features, event_m)
    return tuple(measured)


def _worst_ratio(measured: Sequence[Measurement]) -> float:
    return max((m.ratio(DeviceClass.NOMINAL) for m in measured), default=inf)


def _measure(track: str, features: tuple[Feature, ...], event_m: float | None) -> list[Measurement]:
    placed = place(features, event_m)
    values = (
        abs(placed.start_m),
        100.0 * abs(placed.scale),
        abs(placed.step_m),
        placed.rest_m,
        max(feature.loss for feature in features),
    )
    return [
        Measurement(name, track, value, unit, limits)
        for (name, unit, limits), value in zip(QUANTITIES, values, strict=True)
    ]
