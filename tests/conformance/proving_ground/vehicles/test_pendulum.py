import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid

from floatref import measures
from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.drives.drive import Drive, Segment
from floatref_conformance.proving_ground.drives.phases import speed_change
from floatref_conformance.proving_ground.vehicles.pendulum import (
    Pendulum,
    PendulumMotion,
    SinSquaredPulse,
    simulate_pendulum,
)

G = 9.80665
INTERVAL_M = 0.025
PULSE = SinSquaredPulse(start_s=6.0)


def profile(motion: PendulumMotion, ideal: bool = False) -> tuple[FloatArray, FloatArray]:
    """Distance and high-pass filtered profile from the body's or from ideal sensors."""
    acceleration = motion.vertical if ideal else motion.body_vertical
    height = motion.height if ideal else motion.body_height
    velocity = cumulative_trapezoid(acceleration, motion.time, initial=0.0)
    floating = height[0] + cumulative_trapezoid(velocity, motion.time, initial=0.0)
    x = np.arange(0.0, motion.trolley.distance[-1], INTERVAL_M)
    z = np.interp(x, motion.trolley.distance, floating - height)
    return x, measures.high_pass(z, INTERVAL_M)


def section_iri(x: FloatArray, z: FloatArray, middle: float) -> float:
    return measures.iri(z[np.abs(x - middle) <= 80.45], INTERVAL_M)


def braked(initial_kmh: float) -> tuple[float, PendulumMotion]:
    """A brake by 42 km/h with 3.75 s and more above 0.25 g, and its middle in m."""
    change = speed_change(initial_kmh / 3.6, (initial_kmh - 42) / 3.6, 0.29 * G, 0.6 * G)
    cruise = Segment(100.0 / (initial_kmh / 3.6))
    after = Segment(180.0 / ((initial_kmh - 42) / 3.6))
    drive = Drive(initial_kmh / 3.6, (cruise, *change, after))
    motion = simulate_pendulum(Pendulum(), drive, drive.duration_s, rate_hz=250.0)
    return float(np.mean(drive.knot_distances_m[[1, 4]])), motion


@pytest.fixture(scope="module")
def pulse() -> PendulumMotion:
    return simulate_pendulum(Pendulum(), PULSE, 25.0, rate_hz=500.0)


@pytest.mark.slow
@pytest.mark.cites("(2.23)", "(2.24)")
@given(st.floats(-1.0, 1.5), st.floats(-3.0, 3.0), st.floats(0.05, 0.6))
@settings(deadline=None, max_examples=8)
def test_accelerations_are_second_derivatives_of_the_profilers_place(
    up: float, forward: float, peak_g: float
) -> None:
    pendulum = Pendulum(profiler_up_m=up, profiler_forward_m=forward)
    drive = SinSquaredPulse(peak=peak_g * G, start_s=0.25)
    motion = simulate_pendulum(pendulum, drive, 2.0, rate_hz=1000.0)
    s, c = np.sin(motion.pitch), np.cos(motion.pitch)
    along = motion.trolley.distance + forward * c + up * s
    for place, truth in [(along, motion.longitudinal), (motion.height, motion.vertical)]:
        derived = np.diff(place, 2) * 1000.0**2
        np.testing.assert_allclose(derived, truth[1:-1], atol=2e-3 * peak_g * G)


@pytest.mark.slow
@pytest.mark.cites("(2.20)", "(2.25)")
@given(st.floats(-1.0, 1.5), st.floats(-3.0, 3.0))
@settings(deadline=None, max_examples=5)
def test_equation_2_20_recovers_the_plumb_acceleration(up: float, forward: float) -> None:
    pendulum = Pendulum(profiler_up_m=up, profiler_forward_m=forward)
    motion = simulate_pendulum(pendulum, PULSE, 10.0, rate_hz=200.0)
    s, c = np.sin(motion.pitch), np.cos(motion.pitch)
    recovered = -motion.body_longitudinal * s + (motion.body_vertical + G) * c - G
    np.testing.assert_allclose(recovered, motion.vertical, atol=1e-12)
    np.testing.assert_allclose(motion.body_height * c, motion.height, atol=1e-12)


def test_the_scheme_is_of_fourth_order() -> None:
    fine = simulate_pendulum(Pendulum(), PULSE, 9.0, rate_hz=400.0).pitch
    errors = [
        np.abs(simulate_pendulum(Pendulum(), PULSE, 9.0, rate_hz=rate).pitch - fine[:: 400 // rate])
        for rate in (25, 50)
    ]
    assert 10.0 < errors[0].max() / errors[1].max() < 25.0


@pytest.mark.cites("(2.22)")
def test_a_steady_brake_leans_the_body_forward_by_its_pitch_gain() -> None:
    pendulum = Pendulum()
    drive = Drive(30.0, (Segment(8.0, -0.2 * G),))
    settled = simulate_pendulum(pendulum, drive, 7.9, rate_hz=200.0).pitch[-1]
    assert settled == pytest.approx(0.2 * pendulum.pitch_gain, rel=0.01)
    assert 2.0 < np.degrees(pendulum.pitch_gain) < 5.0


@pytest.mark.cites("(2.22)")
def test_an_undamped_body_swings_at_its_natural_frequency() -> None:
    pendulum = Pendulum(damping=0.0)
    pitch = simulate_pendulum(pendulum, SinSquaredPulse(start_s=0.0), 11.0, rate_hz=500.0).pitch
    upward = np.flatnonzero((pitch[500:-1] < 0) & (pitch[501:] >= 0))
    assert (upward.size - 1) / np.ptp(upward) * 500.0 == pytest.approx(
        pendulum.natural_frequency_hz, rel=2e-3
    )


@pytest.mark.cites("(2.26)")
def test_the_pulse_takes_22_to_20_metres_per_second() -> None:
    times = np.linspace(5.5, 7.5, 20_001)
    motion = PULSE.motion(times)
    step = times[1] - times[0]
    np.testing.assert_allclose(
        np.gradient(motion.distance, step)[1:-1], motion.speed[1:-1], atol=1e-6
    )
    np.testing.assert_allclose(np.gradient(motion.speed, step), motion.acceleration, atol=1e-3)
    assert motion.speed[-1] == pytest.approx(20.0, abs=0.05)
    assert motion.acceleration.min() == pytest.approx(-0.4 * G)


@pytest.mark.slow
def test_figure_2_18_the_body_reads_gravity_while_it_leans(pulse: PendulumMotion) -> None:
    braking = (pulse.time > 6.2) & (pulse.time < 6.9)
    assert (pulse.body_longitudinal - pulse.longitudinal)[braking].max() < 0.0


@pytest.mark.slow
def test_figure_2_19_the_body_reads_too_little_during_the_pulse_only(
    pulse: PendulumMotion,
) -> None:
    bias = pulse.body_vertical - pulse.vertical
    during = (pulse.time >= 6.0) & (pulse.time <= 7.0)
    assert bias[during].mean() < -0.02
    assert np.abs(bias[~during]).max() < 0.1 * np.abs(bias).max()
    onset = pulse.vertical[during]
    assert np.argmin(onset[:150]) < np.argmax(onset)


def test_figure_2_20_the_profiler_dips_by_about_50_mm_and_the_range_sees_it(
    pulse: PendulumMotion,
) -> None:
    assert 0.025 < pulse.height[0] - pulse.height.min() < 0.1
    assert pulse.height[-1] == pytest.approx(pulse.height[0], abs=1e-4)
    assert np.abs(pulse.body_height - pulse.height).max() < 1e-3


def test_figure_2_21_the_profile_bulges_at_the_pulse_and_ideal_sensors_see_a_flat_road(
    pulse: PendulumMotion,
) -> None:
    x, z = profile(pulse)
    before_end = x < x[-1] - 150.0
    top = int(np.argmax(z[before_end]))
    assert 0.005 < z[top] < 0.02
    assert abs(x[top] - 22.0 * 6.5) < 15.0
    beside = (np.abs(x - x[top]) > 20.0) & (np.abs(x - x[top]) < 60.0)
    assert z[beside].max() < 0.2 * z[top]
    _, flat = profile(pulse, ideal=True)
    assert np.abs(flat).max() < 1e-5


def test_figure_2_22_the_bulge_is_a_small_and_local_roughness(pulse: PendulumMotion) -> None:
    x, z = profile(pulse)
    assert 0.038 / 2 < section_iri(x, z, 22.0 * 6.5) < 0.038 * 2
    short = measures.short_interval_roughness(z, INTERVAL_M)
    inner = short[: int((x[-1] - 150.0) / INTERVAL_M)]
    rough = np.flatnonzero(inner > 0.25 * inner.max()) * INTERVAL_M
    assert np.ptp(rough) < 40.0
    assert abs(np.mean(rough) - 22.0 * 6.5) < 20.0


@pytest.mark.slow
def test_figure_2_25_a_long_brake_adds_more_and_at_low_speed_far_more() -> None:
    middle, motion = braked(79.0)
    at_79 = section_iri(*profile(motion), middle)
    assert 0.055 / 2.5 < at_79 < 0.055 * 2.5
    middle, motion = braked(48.0)
    x, z = profile(motion)
    assert 1.83 / 2.5 < section_iri(x, z, middle) < 1.83 * 2.5
    assert z[np.abs(x - middle) < 40.0].max() > 0.2


def test_impossible_pendulums_are_refused() -> None:
    with pytest.raises(InputError, match="lets the pendulum fall over"):
        Pendulum(stiffness=20e3)
    with pytest.raises(InputError, match="mass and arm"):
        Pendulum(mass_kg=0.0)
    with pytest.raises(InputError, match="duration 0"):
        simulate_pendulum(Pendulum(), PULSE, 0.0)
