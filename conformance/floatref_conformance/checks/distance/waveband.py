"""`waveband`: gain and phase at each wavelength are those of the required filter."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import cycle
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.encoder_axis import EncoderAxis
from floatref_conformance.checks.interface import Bench
from floatref_conformance.checks.rounded import seeds
from floatref_conformance.checks.stretches import Stretches, points, stretch, verify_stretches
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort, Limits, same_limit, write_limits
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.proving_ground.roads.sines import (
    BEYOND_M,
    CUT_OFF_M,
    LONGEST_FLAT_M,
    SHORTEST_FLAT_M,
    WAVELENGTHS_M,
)
from floatref_conformance.proving_ground.staging import drive_of

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

ComplexArray = NDArray[np.complex128]


def waves_of(x: FloatArray, elevation: FloatArray, wavelengths_m: FloatArray) -> ComplexArray:
    """Return the complex amplitude of every wave in m, with the phase at distance 0.

    A wave c is the real part of c·exp(2πi·x/λ). A level and a slope are fitted with the waves.

    Args:
        x: places of the points, in m, shape (n,).
        elevation: in m, shape (n,).
        wavelengths_m: shape (m,), all different.
    """
    angle = np.outer(2 * np.pi / wavelengths_m, x)
    level = np.stack([np.ones_like(x), (x - x.mean()) / (x[-1] - x[0])])
    rows = np.concatenate([np.cos(angle), np.sin(angle), level])
    found = np.linalg.solve(rows @ rows.T, rows @ elevation)
    count = wavelengths_m.size
    return np.asarray(found[:count] - 1j * found[count : 2 * count], dtype=np.complex128)


GAIN_LIMITS: Limits = same_limit(1.0, 0.75)
CUT_OFF_LIMITS: Limits = same_limit(0.5, 0.25)
BEYOND_LIMITS: Limits = same_limit(0.30, 0.25)
DISPLACEMENT_LIMITS: Limits = same_limit(0.03, 0.015)
PHASE_LIMITS: Limits = same_limit(2.0, 1.0)
SHORT_M = 10.0
"""Below this wavelength in m, phases are judged as displacements, equal for equal delays."""
QUANTITIES = (
    (f"gain error, {SHORTEST_FLAT_M} to {LONGEST_FLAT_M} m", "%", GAIN_LIMITS),
    (f"gain at {CUT_OFF_M} m off -3.01 dB", "dB", CUT_OFF_LIMITS),
    (f"gain at {BEYOND_M} m", "", BEYOND_LIMITS),
    (f"displacement, {SHORTEST_FLAT_M} to {SHORT_M:g} m", "m", DISPLACEMENT_LIMITS),
    (f"phase, {SHORT_M:g} to {CUT_OFF_M} m", "deg", PHASE_LIMITS),
)
"""What is measured, its unit, and its limits."""
START_M, PERIOD_M, LENGTH_M = 163.0, 274.32, 600.0
"""Start and length of the fit, and length of the run, in m; the fit has two periods or more."""
SPACING_M = 0.05
"""Spacing of the fitted points, in m: twelve in the shortest wave."""
VEHICLES = ("loaded-van", "minivan", "pickup", "trailer")
RATES_HZ = (16000.0, 4000.0, 8000.0)
COUNT: Mapping[Effort, int] = {Effort.QUICK: 4, Effort.CERTIFICATION: 16}
SMALLEST_GAIN = 1e-6
"""Lower limit of the gain, so that its logarithm is finite."""


DERIVATION = (
    f"The road is a sum of {WAVELENGTHS_M.size} sine waves of equal slope: {BEYOND_M} m, "
    f"{CUT_OFF_M} m, and five to an octave from {LONGEST_FLAT_M} to {SHORTEST_FLAT_M} m; the seed "
    f"draws their phases. It is driven at 72 km/h for {LENGTH_M:g} m. Over {PERIOD_M} m, "
    f"{START_M:g} m from both ends, all waves, a level and a slope are fitted to the profile and "
    "to the unfiltered truth; the ratio of the complex amplitudes is gain and phase. A point of "
    "the profile lies where the vehicle was when the encoder had this distance. The sensors have "
    "no errors, the laser is at its accelerometer, and the road is smooth (IRI 0.5 m/km), so that "
    "tilt of the body, of second order, stays below 0.2 % and what is judged is the software: "
    "the mean age of a laser reading held at 3.24 kHz, 0.155 ms, alone would cost 1 % near 9 m, "
    "where the body moves more than the road and has to cancel. Gain: 1 % is asked; HPF_B3x2 takes "
    "0.44 % at 42.9 m, reference may have 0.75 %. Cut-off: 0.5 dB is a cut-off "
    "wavelength wrong by 3.5 %, 0.25 dB by 1.7 %; "
    "an error of 10 % makes 1.2 or 2.0 dB. Beyond it: HPF_B3x2 has a gain of 0.175 at 137.16 m, a "
    "single pass of third order 0.284; 0.30 requires an order of three, 0.25 a higher one. "
    "Displacement: the anti-alias filter of 1000 Hz (2/ω) is worth 6.4 mm, a sample at 4 kHz "
    "5 mm, half an interval of the profile 2.5 mm, 14 mm together; twice that is allowed, and "
    "to reference 15 mm. Phase: 0.03 m are 1.1 degrees at 10 m, the run-in of the filter from "
    "both ends leaves 0.4 degrees at 91.44 m: 2 degrees, for reference 1. A high-pass without "
    "its reverse pass turns 42.9 m by 48 degrees."
)
"""How gain and phase are found, and where the limits come from."""
FLOOR = (
    "Every wave of 0.6 to 42.9 m has to be there with its height: a missing wave has gain 0, "
    "an error of 100 %. A moving average over 0.25 m takes 26 % of the shortest wave."
)
"""What the profile must contain."""


@dataclass(frozen=True)
class WavebandCheck:
    """Compares the waves in a profile with those of the road."""

    id: str = "waveband"
    title: str = "each waveband is passed as the filter says"
    clause: str = (
        "AASHTO M 328-14, high-pass filter of 3 dB at 91.44 m; Karamihas 2021, section 2.1.4, "
        "waveband of the IRI, and section 5.3, gain 0.996 at 42.9 m"
    )
    derivation: str = DERIVATION
    floor: str = FLOOR
    needs: frozenset[str] = frozenset()
    edition: Edition = field(default_factory=find_edition)

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """The limits of the five quantities."""
        return {name: write_limits(limits, unit) for name, unit, limits in QUANTITIES}

    @property
    def simplest(self) -> Case:
        """The loaded van at 16 kHz."""
        return self._case(0, VEHICLES[0], RATES_HZ[0])

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the cases, each with its own phases; vehicles and rates come in turn."""
        source = np.random.SeedSequence([seed, *self.id.encode()])
        drawn = zip(source.generate_state(COUNT[effort]), cycle(VEHICLES), cycle(RATES_HZ))
        return tuple(
            self._case(int(phases), vehicle, rate_hz, f"{self.id}-{n}")
            for n, (phases, vehicle, rate_hz) in enumerate(drawn, start=1)
        )

    def strategy(self) -> "SearchStrategy[Case]":
        """Return any phases under any of the vehicles and rates."""
        from hypothesis import strategies as st

        return st.builds(
            self._case,
            seeds(),
            st.sampled_from(VEHICLES),
            st.sampled_from(RATES_HZ),
        )

    def list_scored(self, case: Case) -> Stretches:
        """Return the stretch over which the waves are fitted.

        Raises InputError for a drive that is too short, or over a road of another kind.
        """
        if case.scenario.road != "sines":
            raise InputError(f"road {case.scenario.road}: {self.id} needs sines")
        length_m = drive_of(case.scenario).length_m
        return verify_stretches(((START_M, START_M + PERIOD_M),), length_m)

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Return the errors of gain and phase of every wheel path.

        Raises InputError for what `list_scored` refuses, DeviceError for a point without elevation
        in the stretch that is fitted.
        """
        self.list_scored(case)
        taken = bench.simulate(case.scenario)
        profile = bench.run(taken)
        axis = EncoderAxis.of(taken)
        measured: list[Measurement] = []
        for name in (track.name for track in taken.truth.tracks):
            true = _fit_waves(taken.truth, name, None)
            measured += _measure(name, _fit_waves(profile, name, axis) / true)
        return tuple(measured)

    def _case(self, seed: int, vehicle: str, rate_hz: float, name: str = "") -> Case:
        scenario = self.edition.make_scenario(
            seed=seed,
            road="sines",
            iri_m_per_km=0.5,
            vehicle=vehicle,
            length_m=LENGTH_M,
            sensors=0.0,
            laser_ahead_m=0.0,
            rate_hz=rate_hz,
        )
        return Case(self.id, scenario, name=name)


def _fit_waves(profile: Profile, track: str, axis: EncoderAxis | None) -> ComplexArray:
    """Return the waves of a wheel path, with its points at their true places."""
    ends = np.array([START_M, START_M + PERIOD_M])
    start, end = ends if axis is None else axis.to_encoder(ends)
    elevation = stretch(profile, track, start, end)
    x = profile.distance_m[points(profile, start, end)]
    chosen = slice(None, None, max(1, int(SPACING_M / profile.interval_m)))
    at = x[chosen] if axis is None else axis.to_true(x[chosen])
    return waves_of(at, elevation[chosen], WAVELENGTHS_M)


def _measure(track: str, passed: ComplexArray) -> list[Measurement]:
    """Return the errors of a complex gain per wave."""
    gain, turned = np.abs(passed), np.abs(np.angle(passed, deg=True))
    flat = WAVELENGTHS_M <= LONGEST_FLAT_M + 1e-9
    short = WAVELENGTHS_M < SHORT_M
    at_cut_off = float(gain[WAVELENGTHS_M == CUT_OFF_M][0])
    decibel = 20.0 * np.log10(max(at_cut_off, SMALLEST_GAIN))
    values = (
        100.0 * np.max(np.abs(gain[flat] - 1.0)),
        abs(decibel - 20.0 * np.log10(0.5**0.5)),
        gain[WAVELENGTHS_M == BEYOND_M][0],
        np.max(turned[short] / 360.0 * WAVELENGTHS_M[short]),
        np.max(turned[~short & (WAVELENGTHS_M <= CUT_OFF_M)]),
    )
    return [
        Measurement(name, track, float(value), unit, limits)
        for (name, unit, limits), value in zip(QUANTITIES, values, strict=True)
    ]
