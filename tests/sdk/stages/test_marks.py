"""Marks for slow travel and for braking near a standstill."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.stages.marks import MarkDrive
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

RATE = 200
G = 9.80665
ACCELERATION, DISTANCE = ChannelId("vertical_acceleration", "left"), ChannelId("distance")


def marked(
    speed: np.ndarray, count_m: float = 0.0, lost: tuple[int, ...] = (), **limits: float
) -> np.ndarray:
    """Return the flags of a drive at ``speed`` in m/s, its encoder counting in ``count_m``."""
    distance = np.cumsum(speed) / RATE
    distance[list(lost)] = np.nan
    if count_m:
        # The encoder begins within a count, not on its edge, where rounding would decide.
        distance = count_m * np.floor(distance / count_m + 0.3719)
    channels = frozenset({ACCELERATION, DISTANCE})
    stage = MarkDrive(**limits)
    stage.start(Header(Axis.TIME, 1 / RATE, 0.0, Fraction(RATE), channels, ("left",)))
    out = stage.push(Block(0, {ACCELERATION: np.zeros(speed.size), DISTANCE: distance}))
    return out.flags.get(ACCELERATION, np.zeros(speed.size, np.uint8))


@settings(deadline=None, max_examples=40)
@given(st.floats(0.0, 35.0), st.sampled_from([0.0, 0.0003, 0.01]))
def test_a_steady_speed_is_slow_below_16_km_h_however_coarse_the_encoder(speed, count_m):
    flags = marked(np.full(5 * RATE, speed), count_m)[RATE:]
    if speed < 4.4704 - 0.03:
        assert (flags == Flag.SLOW).all()
    elif speed > 4.4704 + 0.03:
        assert (flags == 0).all()


@settings(deadline=None, max_examples=60)
@given(
    braking=st.floats(0.05, 0.9),
    stopping_time=st.floats(1.0, 10.0),
    count_m=st.sampled_from([0.0, 0.0003, 0.001]),
)
def test_a_brake_is_marked_once_it_would_stop_within_the_time(braking, stopping_time, count_m):
    times = np.arange(12 * RATE) / RATE
    speed = np.clip(40.0 - braking * G * times, 0.0, None)
    flags = marked(speed, count_m, slow_mps=1e-6, stopping_time_s=stopping_time)
    middle = times - 0.25
    left = 40.0 / (braking * G) - middle
    unsure = 0.05 + 2 * count_m / 0.25**2 / (braking * G) * stopping_time
    inside = (middle > 0.5) & (left > 0.5)
    assert (flags[inside & (left < stopping_time - unsure)] == Flag.BRAKING).all()
    assert (flags[inside & (left > stopping_time + unsure)] == 0).all()


@settings(deadline=None, max_examples=40)
@given(speed=st.floats(5.0, 35.0), count_m=st.floats(0.02, 0.5))
def test_counts_of_a_held_encoder_are_no_braking(speed, count_m):
    assert not (marked(np.full(5 * RATE, speed), count_m) & Flag.BRAKING).any()


@settings(deadline=None, max_examples=40)
@given(braking=st.floats(0.2, 0.9), count_m=st.floats(0.005, 0.05))
def test_a_brake_of_many_counts_is_marked_with_a_held_encoder(braking, count_m):
    times = np.arange(12 * RATE) / RATE
    speed = np.clip(12.0 - braking * G * (times - 2.0).clip(0.0), 0.0, None)
    flags = marked(speed, count_m)
    short_m = braking * G * 0.25**2
    left = 12.0 / (braking * G) + 2.0 - (times - 0.25)
    hard = (times > 2.6) & (speed > 4.4704 + 0.5 * braking * G)
    hard &= (left < 3.0) & (short_m > 6 * count_m)
    assert (flags[hard] & Flag.BRAKING).all()


@settings(deadline=None, max_examples=20)
@given(st.floats(5.0, 35.0), st.floats(0.1, 0.9))
def test_twice_the_speed_bears_twice_the_brake(speed, braking):
    times = np.arange(2 * RATE) / RATE
    once = marked(speed - braking * times, slow_mps=1e-6, stopping_time_s=20.0)
    twice = marked(2 * speed - 2 * braking * times, slow_mps=1e-6, stopping_time_s=20.0)
    assert np.count_nonzero(once != twice) <= 1


def test_staged_brakes_are_marked_where_released_if_they_nearly_always_raised_the_roughness():
    def marked_at_the_end(from_kmh: float, to_kmh: float, braking: float) -> bool:
        seconds = (from_kmh - to_kmh) / 3.6 / (braking * G)
        times = np.arange(round(seconds * RATE)) / RATE
        return bool(marked(from_kmh / 3.6 - braking * G * times)[-1] & Flag.BRAKING)

    for speeds in ((72.0, 32.0), (48.0, 24.0)):
        assert marked_at_the_end(*speeds, 0.26)
        assert not marked_at_the_end(*speeds, 0.1)


def test_a_standstill_is_slow_to_its_end_and_speeding_up_is_no_braking():
    speed = np.concatenate((np.zeros(2 * RATE), np.linspace(0.0, 20.0, 4 * RATE)))
    flags = marked(speed)
    assert (flags[RATE : 2 * RATE] == Flag.SLOW).all()
    assert not (flags & Flag.BRAKING).any()
    assert flags[-1] == 0


def test_limits_are_settings():
    speed = np.full(3 * RATE, 7.0)
    assert not marked(speed).any()
    assert marked(speed, slow_mps=8.0)[RATE:].all()


def test_a_missing_distance_marks_nothing_by_itself():
    assert not marked(np.full(4 * RATE, 20.0), lost=(2 * RATE,)).any()
    standing = marked(np.zeros(4 * RATE), lost=(2 * RATE,))
    assert np.count_nonzero(standing[RATE:] == 0) == 3


def test_it_belongs_on_the_time_axis():
    header = Header(Axis.DISTANCE, 0.1, 0.0, Fraction(RATE), frozenset({DISTANCE}), ("left",))
    with pytest.raises(InputError, match="time axis"):
        MarkDrive().start(header)
