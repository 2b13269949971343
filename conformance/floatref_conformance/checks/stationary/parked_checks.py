"""The stationary tests of AASHTO R 57-14, `quiescent` and `bounce`: a parked vehicle."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import cycle
from typing import TYPE_CHECKING

import numpy as np

from floatref.errors import InputError
from floatref.measures import iri
from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.evidence import Roughness
from floatref_conformance.checks.interface import Bench
from floatref_conformance.checks.stationary import plate
from floatref_conformance.checks.stretches import END_M, Stretches, stretch, verify_stretches
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort, Limits, same_limit, write_limits
from floatref_conformance.devices.interface import HEIGHT
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.proving_ground.drives.artificial import artificial_drive
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

RATES_HZ = (16000.0, 4000.0)
"""Sampling rates of the cases in turn, with and without need of an anti-alias filter."""
SEARCHED_RATES_HZ = (16000.0, 8000.0, 5000.0, 4000.0, 2000.0)
COUNT: Mapping[Effort, int] = {Effort.QUICK: 4, Effort.CERTIFICATION: 16}


FLOOR = (
    f"A plate of {1000 * plate.PLATE_M:g} mm, 2 to 4 m long, lies under each laser, between 455 "
    "and 530 m and so outside the stretch whose IRI is limited. Place and length follow from the "
    "case's seed; in two wheel paths they are 10 m or more apart. Its rise is the mean of its top "
    f"minus the mean of {plate.SHOULDER_M:g} m of ground on each side, {plate.GAP_M} m beside "
    "each edge left out. It may differ from that of the truth, filtered alike (HPF_B3x2, -3 dB "
    "at 91.44 m), by 10 % of the plate in class nominal, 5 % in adequate and 2 % (0.1 mm) in "
    "reference: the share of a known bump that may be lost or added away from events. Sound "
    "software stays within that: the laser's noise of 0.03 mm averages to 2 µm over the 230 "
    "readings of the shortest top; scale errors of 0.05 % are 2.5 µm; an error b of the "
    "acceleration bends ground, top and ground apart by at most 0.0103 s² times b, 0.076 mm for "
    "the largest bias of 7.4 mm/s² if the high-pass took nothing of it. "
    f"Its place, midway between its edges, may be {plate.NOMINAL_DISPLACEMENT_M:g} m from the "
    "true one (reference: half), without half the profile's interval. The artificial encoder "
    "has no scale error and counts 0.3 mm, so that only delays displace the plate: at 20 m/s the "
    "spacing of samples at 4 kHz is 5 mm, the age of a laser reading held at 3.24 kHz up to "
    "6.2 mm, the delay of the 1000-Hz anti-alias filter (2/ω) 6.4 mm, together 18 mm; the "
    "limit is 2.5 ms. A trailing 250-mm average (0.125 m) exceeds it. "
    f"Every point more than {END_M:g} m from both ends must have an elevation. A profile without "
    "the plate has an error of 100 % of it."
)
"""The purpose of the plate, and the reasons of its limits."""


@dataclass(frozen=True)
class StationaryCheck:
    """Limits the IRI from ``start_m`` to ``end_m``; its floor is the plate outside."""

    id: str
    title: str
    clause: str
    derivation: str
    iri_limits: Limits
    start_m: float
    end_m: float
    floor: str = FLOOR
    needs: frozenset[str] = frozenset({HEIGHT})
    """The plate lies under the laser, and the wheels do not turn."""
    edition: Edition = field(default_factory=find_edition)

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """The limits of the IRI and of the plate's errors."""
        return {
            "IRI": write_limits(self.iri_limits, "m/km"),
            "plate height error": write_limits(plate.LIMITS, "mm"),
            "plate displacement": write_limits(plate.PLACE_LIMITS, "m"),
        }

    @property
    def simplest(self) -> Case:
        """The stationary test of the proving ground."""
        return Case(self.id, self.edition.make_scenario(manoeuvre=self.id))

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the cases, each with its own noise; every rate comes in turn."""
        source = np.random.SeedSequence([seed, *self.id.encode()])
        noises = source.generate_state(COUNT[effort])
        return tuple(
            Case(self.id, self._scenario(int(noise), rate_hz), name=f"{self.id}-{n + 1}")
            for n, (noise, rate_hz) in enumerate(zip(noises, cycle(RATES_HZ), strict=False))
        )

    def strategy(self) -> "SearchStrategy[Case]":
        """Return any noise and plate at any of `SEARCHED_RATES_HZ`."""
        from hypothesis import strategies as st

        scenarios = st.builds(
            self._scenario, st.integers(0, 2**32 - 1), st.sampled_from(SEARCHED_RATES_HZ)
        )
        return scenarios.map(lambda scenario: Case(self.id, scenario))

    def list_scored(self, case: Case) -> Stretches:
        """Return the stretch whose IRI is limited.

        Raises InputError for a vehicle that drives, or an artificial drive that is too short.
        """
        manoeuvre, speed_mps = case.scenario.manoeuvre, case.scenario.speed_kmh * KMH
        if manoeuvre != self.id:
            raise InputError(f"manoeuvre {manoeuvre}: in {self.id} the vehicle is parked")
        return verify_stretches(((self.start_m, self.end_m),), artificial_drive(speed_mps).length_m)

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Return the IRI and the plate's errors of every wheel path.

        Raises InputError for what `list_scored` refuses, DeviceError for a point without elevation
        more than `END_M` from both ends.
        """
        self.list_scored(case)
        taken = bench.simulate(case.scenario)
        profile = bench.run(taken)
        measured: list[Measurement] = []
        for track in taken.truth.tracks:
            stretch(profile, track.name, END_M, taken.truth.distance_m[-1] - END_M)
            measured.append(self._roughness(profile, track.name))
            measured += plate.measure_plate(profile, taken.truth, track.name)
        return tuple(measured)

    def _scenario(self, seed: int, rate_hz: float) -> Scenario:
        return self.edition.make_scenario(seed=seed, manoeuvre=self.id, rate_hz=rate_hz)

    def _roughness(self, profile: Profile, track: str) -> Measurement:
        elevation = stretch(profile, track, self.start_m, self.end_m)
        value = iri(elevation, profile.interval_m)
        evidence = Roughness(elevation, profile.interval_m)
        return Measurement("IRI", track, value, "m/km", self.iri_limits, evidence)


QUIESCENT_NOMINAL = 0.047
"""AASHTO R 57-14, static part of the stationary test."""
QUIESCENT_REFERENCE = QUIESCENT_NOMINAL / 2

QUIESCENT = StationaryCheck(
    id="quiescent",
    title="parked with the engine on, the profile is flat",
    clause="AASHTO R 57-14, static test: IRI 0.047 m/km; class reference: half",
    derivation=(
        "The vehicle stands on a flat floor, its engine at 820 rpm shakes the body by 10 µm at "
        "13.7 Hz, and an artificial encoder gives 72 km/h for 32 s. The IRI is taken over 160.9 m "
        "(0.1 mile) from 200 m on, away from both ends of the run and from the plate: it "
        "measures the noise of the sensors after the processing. The nominal system "
        "of Karamihas 2021 (4.5.1) stayed below 0.01 m/km. Half the limit is asked of class "
        "reference, so that the profiler adds little to the roads on which it judges others."
    ),
    iri_limits=same_limit(QUIESCENT_NOMINAL, QUIESCENT_REFERENCE),
    start_m=200.0,
    end_m=360.9,
)


BOUNCE_NOMINAL = 0.126
"""AASHTO R 57-14, bounce part of the stationary test."""
BOUNCE_REFERENCE = BOUNCE_NOMINAL / 2

BOUNCE = StationaryCheck(
    id="bounce",
    title="motion of the body over a flat floor does not reach the profile",
    clause="AASHTO R 57-14, bounce test: IRI 0.126 m/km; class reference: half",
    derivation=(
        "The vehicle stands on a flat floor with its engine on, an artificial encoder gives "
        "72 km/h, and from 10 s on the body is pushed for 6.5 s at 2 Hz, 56 mm down and 30 mm up "
        "during the middle two thirds. The IRI is taken over just those two thirds, 221.7 to "
        "308.3 m, where the motion is at its most severe: accelerometer and height sensor have to "
        "cancel. The nominal system of Karamihas 2021 (figure 4.7) had 0.05 m/km there. A "
        "difference in delay of 0.155 ms, the mean age of a laser reading held at 3.24 kHz, "
        "leaves 0.08 mm at a wavelength of 10 m. Half the limit is asked of class reference."
    ),
    iri_limits=same_limit(BOUNCE_NOMINAL, BOUNCE_REFERENCE),
    start_m=221.7,
    end_m=308.3,
)
