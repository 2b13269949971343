"""GPS readings of the 17 published runs, as simulated, have the figures of Tables 5.1 and 5.2."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref_conformance.proving_ground.drives.runs import RUNS, SECTION_START_M, run_drive
from floatref_reference.chapter_3.section_3_2_2_coordinates import Origin, along, local
from floatref_reference.chapter_3.section_3_3_5_1_characterization import (
    BAND,
    deceleration,
    is_rejected,
    place,
    standstill,
)

DT, G = 0.05, 9.80665
STOPS = [name for name, run in RUNS.items() if run.kind == "stop"]
BRAKES = [name for name, run in RUNS.items() if run.kind in ("braking", "near-stop")]
PSI = math.radians(-37.68)
ORIGIN = Origin(math.radians(45.26), math.radians(-93.71), 290.0)
FALL_AND_RISE_S = 0.145
"""What a stop takes from and to 0.16 km/h beyond its standstill: 0.01 s at 0.28 g and 0.135 s at
a jerk of 0.5 g per second."""
RESOLUTION = 0.05 / 3.6
"""Half a digit of the speeds of Table 5.2, in m/s."""


def driven(name: str):
    """Return distance from the section's start and speed at 20 Hz."""
    drive = run_drive(name)
    motion = drive.motion(np.arange(0.0, drive.duration_s, DT))
    return motion.distance - SECTION_START_M, motion.speed


def by_gps(name: str, seed: int):
    """Return both as computed from noisy latitude, longitude and speed (Table 3.4, left start)."""
    x, v = driven(name)
    rng = np.random.default_rng(seed)
    east = x * math.cos(PSI) + rng.normal(0, 4.7e-3, x.size)
    north = x * math.sin(PSI) + rng.normal(0, 3.4e-3, x.size)
    radius = float(ORIGIN.R) + ORIGIN.H
    phi = ORIGIN.phi + north / radius
    lam = ORIGIN.lam + east / radius / np.cos(phi)
    places = [along(local(p, q, ORIGIN), PSI) for p, q in zip(phi, lam, strict=True)]
    return np.array([at.forward for at in places]), v + rng.normal(0, 0.03, v.size)


@pytest.mark.cites("Table 5.1")
@pytest.mark.parametrize("name", STOPS)
def test_a_stop_has_its_published_figures(name: str) -> None:
    run, (x, v) = RUNS[name], driven(name)
    pulse, stop = deceleration(v, DT), standstill(x, v, DT)
    assert float(pulse.average) == pytest.approx(run.mean_deceleration_g, abs=5e-4)
    assert pulse.peak > pulse.average
    assert float(stop.location) == pytest.approx(run.event_location_m, abs=0.005)
    assert float(stop.duration) - run.dwell_s == pytest.approx(FALL_AND_RISE_S, abs=0.01)


@pytest.mark.cites("Table 5.2")
@pytest.mark.parametrize("name", BRAKES)
def test_a_brake_has_its_published_figures(name: str) -> None:
    run, (x, v) = RUNS[name], driven(name)
    v_0, v_1 = run.initial_speed_kmh / 3.6, run.event_speed_kmh / 3.6
    pulse = deceleration(v, DT, v_0 - RESOLUTION, v_1 + RESOLUTION)
    assert float(pulse.average) == pytest.approx(run.mean_deceleration_g, rel=0.06)
    assert float(place(x, DT, pulse.end)) == pytest.approx(run.event_location_m, abs=v_1 * DT)


@pytest.mark.slow
@pytest.mark.cites("(3.1)", "(3.2)", "(3.3)", "Table 5.1")
@pytest.mark.parametrize("name", STOPS)
def test_noise_of_gps_leaves_these_figures(name: str) -> None:
    """0.03 m/s on the speed is 0.16 km/h at 1.5 sigma: the level of rest is five sigma here."""
    run, (x, v) = RUNS[name], by_gps(name, 3)
    pulse, stop = deceleration(v, DT), standstill(x, v, DT, 0.15)
    assert float(pulse.average) == pytest.approx(run.mean_deceleration_g, abs=3e-3)
    assert float(stop.location) == pytest.approx(run.event_location_m, abs=0.02)
    assert float(stop.duration) == pytest.approx(run.dwell_s, abs=0.35)


@pytest.mark.cites("Table 5.2")
def test_the_run_of_figure_5_2_brakes_for_4_2_s_over_42_m() -> None:
    """49 to 23 km/h from 176.4 to 218.6 m, in 4.2 s; here the brake comes over a metre."""
    x, v = driven("brk_49-23_0.18g_b")
    pulse = deceleration(v, DT, 49.2 / 3.6 - 1e-6, 22.7 / 3.6 + 1e-6)
    assert float(pulse.end - pulse.begin) == pytest.approx(4.2, abs=0.05)
    assert float(place(x, DT, pulse.begin)) == pytest.approx(176.4, abs=1.1)


@settings(max_examples=25)
@given(a=st.floats(0.5, 4.0), phase=st.floats(0.0, 1.0))
def test_a_steady_brake_has_its_deceleration_as_average_and_peak(a: float, phase: float) -> None:
    t = (np.arange(0, 20 / a + 6, DT) + phase * DT) - 2
    v = 20 - a * np.clip(t, 0, 19 / a)
    pulse = deceleration(v, DT, 19.5, 1.5)
    assert float(pulse.average) * G == pytest.approx(a)
    assert float(pulse.peak) * G == pytest.approx(a)
    assert float(pulse.end - pulse.begin) == pytest.approx(18 / a)


def test_a_peak_that_lasts_a_second_is_found_and_a_shorter_one_is_averaged() -> None:
    a = np.full(400, -1.0)
    a[100:120], a[200:210] = -2.0, -2.6
    v = 30 + np.concatenate([[0], np.cumsum(a * DT)])
    assert float(deceleration(v, DT, 29, 10).peak) * G == pytest.approx(2.0)


def test_a_drive_that_does_not_brake_so_far_is_refused() -> None:
    with pytest.raises(ValueError, match="does not fall from"):
        deceleration(np.linspace(20, 5, 100), DT, *BAND)
    with pytest.raises(ValueError, match="never slower"):
        standstill(np.arange(9.0), np.full(9, 4.0), DT)


@settings(max_examples=25)
@given(level=st.floats(0.2, 3.0), at=st.integers(0, 300))
def test_a_pass_with_too_much_throttle_past_the_brake_is_rejected(level: float, at: int) -> None:
    """An acceleration of 1.5 s counts if one whole second of it is within 150 m of the brake."""
    assume(abs(level - 0.1 * G) > 1e-3)
    a = np.where((np.arange(600) >= at) & (np.arange(600) < at + 30), level, 0.0)
    v = 8 + np.concatenate([[0], np.cumsum(a * DT)[:-1]])
    x = np.cumsum(v * DT)
    assert is_rejected(x, v, DT, 0.0) == (level > 0.1 * G)
    assert not is_rejected(x, v, DT, float(x[at + 30]))
    assert not is_rejected(x, v, DT, float(x[at]) - 151)
