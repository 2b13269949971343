"""The stationary tests of AASHTO R 57-14: a parked vehicle whose encoder pretends to travel."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from floatref.measures import iri
from floatref.values.profile import Profile
from floatref_conformance.checks import plate
from floatref_conformance.checks.interface import Case, Truth
from floatref_conformance.checks.stretches import stretch
from floatref_conformance.classes import DeviceClass, Effort, Limits
from floatref_conformance.verdict import Evidence, Measurement

RATES_HZ = (16000.0, 4000.0)
"""The rates of the cases, in turn: with and without need of an anti-alias filter."""
COUNT: Mapping[Effort, int] = {Effort.QUICK: 4}


@dataclass(frozen=True)
class StationaryCase:
    """A parked vehicle, ``kind`` quiescent or bounce, with the plate and one noise seed."""

    name: str
    kind: str
    seed: int
    rate_hz: float

    @property
    def parameters(self) -> Mapping[str, Any]:
        """The numbers that make the case again."""
        return {"kind": self.kind, "seed": self.seed, "rate_hz": self.rate_hz}

    def simulate(self) -> Truth:
        """Return the recording and the flat ground with its plate."""
        from floatref_conformance.proving_ground.simulate import stationary

        return stationary(self.kind, self.seed, self.rate_hz)


@dataclass(frozen=True)
class StationaryCheck:
    """Limits the IRI from ``start_m`` to ``end_m``; the plate, elsewhere, is the floor."""

    id: str
    title: str
    clause: str
    derivation: str
    iri_limits: Limits
    start_m: float
    end_m: float
    needs: frozenset[str] = frozenset()

    @property
    def floor(self) -> str:
        """The plate and how much of it may be missing."""
        return FLOOR

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """The limits of the IRI and of the plate's error."""
        return {
            "IRI": {c: f"{limit:.4g} m/km" for c, limit in self.iri_limits.items()},
            "plate height error": {c: f"{limit:.4g} mm" for c, limit in plate.LIMITS.items()},
        }

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the cases, each with its own noise; every rate comes in turn."""
        source = np.random.SeedSequence([seed, *self.id.encode()])
        return tuple(
            StationaryCase(f"{self.id}-{n + 1}", self.id, int(noise), RATES_HZ[n % len(RATES_HZ)])
            for n, noise in enumerate(source.generate_state(COUNT[effort]))
        )

    def judge(self, case: Case, profile: Profile, simulated: Truth) -> tuple[Measurement, ...]:
        """Return the IRI and the plate's error of every wheel path."""
        tracks = [track.name for track in simulated.truth.tracks]
        flat = [self._roughness(profile, name) for name in tracks]
        return (*flat, *(plate.measure_plate(profile, simulated.truth, name) for name in tracks))

    def _roughness(self, profile: Profile, track: str) -> Measurement:
        elevation = stretch(profile, track, self.start_m, self.end_m)
        value = iri(elevation, profile.interval_m)
        evidence = Evidence(elevation, profile.interval_m)
        return Measurement("IRI", track, value, "m/km", self.iri_limits, evidence)


FLOOR = (
    f"A plate of {1000 * plate.PLATE_M:g} mm lies under the laser for 3 m of the distance, "
    "outside the stretch whose IRI is limited. Its rise is the mean of its top minus the mean of "
    f"the ground beside it (as long as the top, at most {plate.SHOULDER_M:g} m), "
    f"{plate.GAP_M} m beside each edge left out. It may differ from that of the truth, filtered "
    "alike (HPF_B3x2, -3 dB at 91.44 m), by 10 % of the plate in class nominal, 5 % in adequate "
    "and 2 % (0.1 mm) in reference: the share of a known bump that may be lost or added away from "
    "events. Sound software stays within that: the laser's noise of 0.03 mm averages to 2 µm over "
    "the 400 readings of the top; scale errors of 0.05 % are 2.5 µm; an error b of the "
    "acceleration bends ground, top and ground apart by 0.0133 s² times b, 0.098 mm for the "
    "largest bias of 7.4 mm/s² if the high-pass took nothing of it. A profile that shows no "
    "plate is off by all of it."
)
"""What the plate is for, and why its limits are what they are."""
