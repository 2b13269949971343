"""Rates and attitude are compared as Euler angles, whatever the course does."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.roll_and_pitch import read_attitudes, weigh_witnesses
from floatref.screening.slow_series import FORCES, Motion
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

SECONDS = 30.0


def swinging(roll: float, turn: float, pitches: float, seed: int, sign: float = 1.0) -> Recording:
    """A body that swings in pitch, in a slalom on a bank of ``roll``, with exact Euler rates.

    The receiver tells its pitch times ``sign``.
    """
    rng = np.random.default_rng(seed)
    fast = UniformClock.of(100.0)
    times = fast.times(int(100 * SECONDS))
    stamps = 0.0125 + np.arange(int(20 * SECONDS) - 1) / 20.0

    def pitch(t: np.ndarray) -> np.ndarray:
        return pitches * np.sin(2 * np.pi * 1.3 * t)

    heading_rate = turn * np.sin(2 * np.pi * 0.25 * times)
    pitch_rate = pitches * 2 * np.pi * 1.3 * np.cos(2 * np.pi * 1.3 * times)
    rows = {
        "roll_rate": -np.sin(pitch(times)) * heading_rate,
        "pitch_rate": np.cos(roll) * pitch_rate + np.sin(roll) * heading_rate,
        "yaw_rate": np.cos(roll) * heading_rate - np.sin(roll) * pitch_rate,
        "distance": 15.0 * times,
        **dict.fromkeys(FORCES, 0.0 * times),
    }
    receiver = StampedClock.of(stamps)
    attitude = {"gnss_pitch": sign * pitch(stamps), "gnss_roll": roll + 0.0 * stamps}
    readings = (v + 1e-3 * rng.standard_normal(v.size) for v in attitude.values())
    return Recording(
        (
            *(Channel.of(name, row, fast) for name, row in rows.items()),
            *(Channel.of(n, v, receiver) for n, v in zip(attitude, readings, strict=True)),
        )
    )


@settings(deadline=None, max_examples=10)
@given(
    roll=st.floats(-0.12, 0.12),
    turn=st.floats(0.1, 0.5),
    seed=st.integers(0, 9),
    inverted=st.booleans(),
)
def test_a_slalom_on_a_bank_hides_neither_a_right_pitch_nor_a_wrong_one(
    roll: float, turn: float, seed: int, inverted: bool
) -> None:
    """The pitch rate of a turn on a bank is no pitch: θ′ = q cos φ - r sin φ, (6.27)."""
    recording = swinging(roll, turn, 0.01, seed, -1.0 if inverted else 1.0)
    motion = Motion.of(recording, "main")
    assert motion is not None
    _, pitch = weigh_witnesses(motion, read_attitudes(recording, motion))
    assert pitch.attitude.certain if inverted else pitch.attitude.confirmed
    assert pitch.attitude.name == "sign" or not inverted


@pytest.mark.parametrize("seed", range(4))
def test_a_receiver_whose_angles_rest_is_no_witness(seed: int) -> None:
    recording = swinging(0.05, 0.3, 0.0, seed)
    motion = Motion.of(recording, "main")
    assert motion is not None
    roll, pitch = weigh_witnesses(motion, read_attitudes(recording, motion))
    for evidence in (roll.attitude, pitch.attitude):
        assert not evidence.likely
        assert not evidence.confirmed
