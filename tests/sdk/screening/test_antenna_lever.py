"""The antenna's place is read off its swing, and one that the setup gives wrongly is told."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.antenna_lever import check_antenna, locate_antenna
from floatref.screening.gnss_height import gnss_faults
from floatref.screening.slow_series import Motion
from floatref.values.recording import Recording, Setup
from floatref_conformance.proving_ground import Scenario, simulate


@cache
def driven(vehicle: str) -> tuple[Recording, Motion]:
    numbers = {"manoeuvre": "stop", "vehicle": vehicle, "rate_hz": 1000.0}
    recording = simulate(Scenario.from_dict({**numbers, "iri_m_per_km": 4.0})).recording
    motion = Motion.of(recording, "left")
    assert motion is not None
    return recording, motion


def warnings_of(recording: Recording, motion: Motion) -> tuple[str, ...]:
    return tuple(check_antenna(recording, "left", motion, gnss_faults(recording)))


def with_arm(recording: Recording, x: float, y: float, z: float) -> Recording:
    return replace(recording, setup=replace(recording.setup, gnss_antenna_offset_m=(x, y, z)))


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", ["minivan", "pickup", "soft-van"])
def test_the_arm_is_found_within_its_uncertainty(vehicle: str) -> None:
    recording, motion = driven(vehicle)
    found = locate_antenna(recording, "left", motion, gnss_faults(recording))
    assert found is not None
    true = recording.setup.gnss_antenna_offset_m[:2]
    off = np.abs(np.subtract(found.place_m, true)) / np.array(found.sigma_m)
    assert (off < 4.0).all()
    assert max(found.sigma_m) < 0.3
    assert warnings_of(recording, motion) == ()


@pytest.mark.slow
@settings(deadline=None, max_examples=12)
@given(axis=st.sampled_from([0, 1]), by_m=st.sampled_from([-3.0, -1.5, 1.5, 3.0]))
def test_an_arm_that_contradicts_the_swing_is_told(axis: int, by_m: float) -> None:
    recording, motion = driven("soft-van")
    arm = list(recording.setup.gnss_antenna_offset_m)
    arm[axis] += by_m
    (line,) = warnings_of(with_arm(recording, *arm), motion)
    assert line.startswith(f"setup.gnss_antenna_offset_m: {'XY'[axis]} is {arm[axis]:.4g} m")
    found_m = float(line.split(f"{'XY'[axis]} = ")[1].split(" m")[0])
    assert found_m == pytest.approx(recording.setup.gnss_antenna_offset_m[axis], abs=1.0)


@pytest.mark.slow
def test_a_missing_arm_is_told_with_what_the_swing_says() -> None:
    recording, motion = driven("soft-van")
    (line,) = warnings_of(with_arm(recording, 0.0, 0.0, 0.0), motion)
    assert line.startswith("setup.gnss_antenna_offset_m: 0, 0, 0, so the antenna is taken to sit")
    assert "(its swing shows X = -" in line


def test_rates_in_degrees_are_not_blamed_on_the_antenna() -> None:
    recording, motion = driven("soft-van")
    in_degrees = replace(motion, rates=180.0 / np.pi * motion.rates)
    (line,) = warnings_of(recording, in_degrees)
    assert line.startswith("channels roll_rate, pitch_rate: the antenna swings a fraction")
    assert "multiply by 0.0174533" in line


def test_a_parked_vehicle_tells_nothing_of_the_arm() -> None:
    numbers = {"manoeuvre": "quiescent", "rate_hz": 1000.0}
    recording = simulate(Scenario.from_dict(numbers)).recording
    motion = Motion.of(recording, "left")
    assert motion is not None
    faults = gnss_faults(recording)
    assert locate_antenna(recording, "left", motion, faults) is None
    assert warnings_of(with_arm(recording, 5.0, -3.0, 1.0), motion) == ()
    (line,) = warnings_of(replace(recording, setup=Setup()), motion)
    assert line.endswith("measure where it is and give it")
