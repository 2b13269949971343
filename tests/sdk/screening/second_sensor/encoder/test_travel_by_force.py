"""The encoder against the longitudinal force: a brake shows a lag and a wrong unit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.encoder.travel_by_force import force_doubts
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording

RATE, LENGTH_S = 1000.0, 40.0
TIMES = np.arange(int(RATE * LENGTH_S)) / RATE


def braking() -> FloatArray:
    """Return the acceleration of a drive that brakes at 15 s and speeds up again, in m/s²."""
    brake = (TIMES > 15.0) & (TIMES < 20.0)
    return np.where(brake, -2.5, 0.0) + np.where((TIMES > 25.0) & (TIMES < 32.0), 1.5, 0.0)


def travel(acceleration: FloatArray) -> FloatArray:
    return np.cumsum(20.0 + np.cumsum(acceleration) / RATE) / RATE


def doubts(
    late_s: float = 0.0, scale: float = 1.0, hard: float = 1.0, pitch: float = 0.0
) -> list[Doubt]:
    """Return the doubts about an encoder that is late or scaled, beside a force that pitches."""
    source = np.random.default_rng(0)
    counted = scale * np.interp(TIMES - late_s, TIMES, travel(hard * braking()))
    felt = (1.0 + pitch) * hard * braking() + 0.3 + 0.2 * source.standard_normal(TIMES.size)
    clock = UniformClock.of(RATE)
    return list(
        force_doubts(
            Recording(
                (
                    Channel.of("distance", counted, clock),
                    Channel.of("longitudinal_specific_force", felt, clock, "left"),
                )
            )
        )
    )


@given(pitch=st.floats(-0.1, 0.2), late_s=st.floats(-0.1, 0.1))
@settings(max_examples=15, deadline=None)
def test_a_sound_encoder_raises_no_doubt(pitch: float, late_s: float) -> None:
    assert not doubts(late_s, pitch=pitch)


@pytest.mark.parametrize("late_s", [0.5, 1.0, 3.0, -1.0])
def test_a_lag_is_found_at_its_size(late_s: float) -> None:
    (doubt,) = doubts(late_s)
    assert f"{abs(late_s):.1f} s {'later' if late_s > 0 else 'earlier'}" in doubt.line
    assert not doubt.fatal


@pytest.mark.parametrize("scale", [0.3048, 3.28, 2.0])
def test_a_wrong_unit_is_named(scale: float) -> None:
    (doubt,) = doubts(scale=scale)
    assert f"{scale:.3g} times" in doubt.line


def test_without_a_brake_nothing_is_known() -> None:
    assert not doubts(3.0, hard=0.05)
