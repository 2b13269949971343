"""By a measured attitude the height is that of a rigid body, and the stage keeps the laws."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman.inputs import IMU
from floatref.estimators.laser_place import HeightByAttitude
from floatref.estimators.levelling import Level
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref_conformance.testing import StageLaws

X, Y, ROLL, PITCH, YAW = (ChannelId(name) for name in IMU)
HEIGHT, DISTANCE = ChannelId("height", "left"), ChannelId("distance")
RATE, SECONDS, SPEED = 200, 40.0, 20.0


def swinging(pitch_hz: float, roll_hz: float, grade: float) -> tuple[dict, np.ndarray, np.ndarray]:
    """Return the sensors of a body that pitches and rolls at constant speed, and both angles."""
    t = np.arange(round(RATE * SECONDS)) / RATE
    pitch = grade + 0.02 * np.sin(2 * np.pi * pitch_hz * t)
    roll = 0.01 * np.sin(2 * np.pi * roll_hz * t)
    pitching, rolling = np.gradient(pitch, t), np.gradient(roll, t)
    values = {
        X: -STANDARD_GRAVITY * np.sin(pitch),
        Y: STANDARD_GRAVITY * np.cos(pitch) * np.sin(roll),
        PITCH: pitching * np.cos(roll),
        YAW: -pitching * np.sin(roll),
        ROLL: rolling,
        DISTANCE: SPEED * t,
        HEIGHT: np.full(t.size, 0.3),
    }
    return values, pitch, roll


@pytest.mark.slow
@settings(deadline=None, max_examples=8)
@example(1.7, 1.71, 0.0, (0.0, 0.5))
@given(
    st.floats(0.1, 2.0),
    st.floats(0.1, 2.0),
    st.floats(-0.05, 0.05),
    st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
)
def test_a_laser_on_a_lever_is_as_high_as_the_rigid_body_says(
    pitch_hz: float, roll_hz: float, grade: float, lever: tuple[float, float]
) -> None:
    """-x sin θ + y cos θ sin φ, with θ nose down and φ left side up positive (6.23).

    Gravity tells the slow attitude from some 10 s to both sides, which the ends lack. A body that
    pitches and rolls in one rhythm has a mean yaw rate of θ' φ, which is taken for a bend.
    """
    values, pitch, roll = swinging(pitch_hz, roll_hz, grade)
    stage = HeightByAttitude({"left": lever})
    channels = frozenset(values)
    out_header = stage.start(Header(Axis.TIME, 1 / RATE, 0.0, Fraction(RATE), channels, ("left",)))
    assert out_header.channels == channels
    size = values[X].size
    parts = [stage.push(Block(i, {c: v[i : i + 500] for c, v in values.items()}))
             for i in range(0, size, 500)]  # fmt: skip
    out = join_blocks([b for b in (*parts, *stage.finish()) if len(b)])
    raised = -lever[0] * np.sin(pitch) + lever[1] * np.cos(pitch) * np.sin(roll)
    both_sides = slice(10 * RATE, -10 * RATE)
    yaw = 0.5 * 0.02 * 2 * np.pi * pitch_hz * 0.01 * (abs(pitch_hz - roll_hz) < 0.2)
    atol = 2e-4 + 1.1 * abs(lever[1]) * SPEED * yaw / STANDARD_GRAVITY
    np.testing.assert_allclose(out[HEIGHT][both_sides], (0.3 - raised)[both_sides], atol=atol)


@pytest.mark.slow
def test_levelling_carries_the_heights_by_the_same_attitude() -> None:
    """One stage in place of two, bit for bit; a height keeps its own flags."""
    values, pitch, roll = swinging(0.7, 0.4, 0.01)
    force = STANDARD_GRAVITY * np.cos(pitch) * np.cos(roll)
    values[ChannelId("vertical_specific_force", "left")] = force
    marks = np.zeros(force.size, np.uint8)
    marks[4000] = Flag.MISSING
    channels, found = frozenset(values), []
    for stage in (HeightByAttitude({"left": (0.3, 0.1)}), Level(levers_m={"left": (0.3, 0.1)})):
        stage.start(Header(Axis.TIME, 1 / RATE, 0.0, Fraction(RATE), channels, ("left",)))
        parts = [stage.push(Block(0, values, {}, {HEIGHT: marks})), *stage.finish()]
        found.append(join_blocks([b for b in parts if len(b)]))
    np.testing.assert_array_equal(found[0][HEIGHT], found[1][HEIGHT])
    for out in found:
        np.testing.assert_array_equal(out.flags[HEIGHT], marks)
    level = found[1][ChannelId("vertical_acceleration", "left")]
    assert np.abs(level[1000:-1000]).max() < 0.01


class TestHeightByAttitude(StageLaws):
    reads = ("height",)
    shared = (*IMU, "distance")
    keeps_index = True
    reach = None

    def make(self) -> HeightByAttitude:
        return HeightByAttitude({"left": (0.3, 0.1), "right": (-0.1, 0.0)})
