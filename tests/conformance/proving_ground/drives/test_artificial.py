import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.drives.artificial import (
    Bounce,
    Plate,
    Stationary,
    artificial_drive,
)

RATE_HZ = 4000.0
TIMES = np.arange(int(32 * RATE_HZ)) / RATE_HZ


@given(st.floats(1.0, 4.0), st.floats(3.0, 10.0), st.floats(0.0, 1e-4))
@settings(deadline=None, max_examples=10)
def test_velocity_and_acceleration_are_derivatives_of_the_height(
    frequency: float, duration: float, engine: float
) -> None:
    bounce = Bounce(frequency_hz=frequency, duration_s=duration)
    body = Stationary(bounce, engine_m=engine).body(TIMES)
    for values, derivative in [
        (body.height, body.velocity),
        (body.velocity, body.acceleration),
        (body.pitch, body.pitch_rate),
        (body.pitch_rate, body.pitch_acceleration),
        (body.roll, body.roll_rate),
        (body.roll_rate, body.roll_acceleration),
    ]:
        derived = (values[2:] - values[:-2]) * RATE_HZ / 2
        scale = np.abs(derivative).max() + 1e-9
        np.testing.assert_allclose(derived, derivative[1:-1], atol=2e-3 * scale)


def test_the_bounce_goes_56_mm_down_and_30_mm_up_near_2_hz_in_its_middle_two_thirds() -> None:
    height = Stationary(Bounce(), engine_m=0.0).body(TIMES).height
    middle = (TIMES > 10.0 + 6.5 / 6) & (TIMES < 16.5 - 6.5 / 6)
    assert height[middle].min() == pytest.approx(-0.056, abs=1e-5)
    assert height[middle].max() == pytest.approx(0.030, abs=1e-5)
    assert height.min() == pytest.approx(-0.056, abs=1e-5)
    bottoms = np.flatnonzero((np.diff(height[:-1]) < 0) & (np.diff(height[1:]) >= 0))
    deep = bottoms[height[bottoms] < -0.0559]
    assert (deep.size - 1) / np.ptp(TIMES[deep]) == pytest.approx(2.0, rel=1e-3)


def test_before_and_after_the_bounce_only_the_engine_shakes() -> None:
    bouncing, quiet = Stationary(Bounce()).body(TIMES), Stationary().body(TIMES)
    outside = (TIMES <= 10.0) | (TIMES >= 16.5)
    assert np.array_equal(bouncing.height[outside], quiet.height[outside])
    assert not bouncing.pitch[outside].any()
    shaken = np.abs(np.fft.rfft(quiet.height))
    assert np.fft.rfftfreq(TIMES.size, 1 / RATE_HZ)[np.argmax(shaken)] == pytest.approx(
        820 / 60, abs=0.04
    )
    assert not quiet.roll.any()


def test_acceleration_has_no_step_so_that_any_sensor_can_follow() -> None:
    acceleration = Stationary(Bounce(), engine_m=0.0).body(TIMES).acceleration
    largest = np.abs(acceleration).max()
    assert np.abs(np.diff(acceleration)).max() < 2 * np.pi * 2.5 / RATE_HZ * largest


@given(st.floats(0.5, 10.0), st.floats(-0.02, 0.02), st.floats(0.0, 0.25), st.floats(50.0, 200.0))
@settings(deadline=None, max_examples=30)
def test_a_plate_has_its_height_and_its_length(
    length: float, height: float, edge: float, start: float
) -> None:
    plate = Plate(start, length, height, edge)
    x = np.linspace(start - 1.0, start + length + 1.0, 50_001)
    z = plate.elevation(x)
    assert plate.elevation(np.array([start + length / 2]))[0] == pytest.approx(height)
    assert not z[(x < start - 1e-6) | (x > start + length + 1e-6)].any()
    area = z.mean() * (length + 2.0)
    assert area == pytest.approx(height * (length - edge), rel=2e-3, abs=1e-9)


def test_the_artificial_encoder_tells_72_km_h_for_640_m() -> None:
    drive = artificial_drive()
    assert drive.length_m == pytest.approx(640.0)
    assert drive.motion(np.array([1.0])).speed[0] == pytest.approx(72 / 3.6)


def test_impossible_bounces_and_plates_are_refused() -> None:
    with pytest.raises(InputError, match="duration, frequency and travel"):
        Bounce(lowest_m=0.1)
    with pytest.raises(InputError, match="the edges must fit"):
        Plate(480.0, length_m=0.1, edge_m=0.06)
