"""The state of a channel: counts that no cut of the samples changes, and each fault by its name."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.live.monitor.sensor_health import (
    MOVES_MPS,
    RECENT_S,
    SILENT_S,
    STUCK,
    STUCK_S,
    Health,
    SensorHealth,
)
from floatref.live.session.messages import Piece
from floatref.values.clock import UniformClock

RATE_HZ = 100.0
FAST_MPS = 2.0 * MOVES_MPS
VALUES = st.lists(st.sampled_from([0.0, 1.0, np.nan]), min_size=1, max_size=120)


def fed(values, cuts=(), name="left.height", stamped=False):
    values = np.asarray(values, dtype=float)
    sensor = SensorHealth(name, None if stamped else UniformClock.of(RATE_HZ))
    ends = sorted({0, values.size, *(min(c, values.size) for c in cuts)})
    for low, high in pairwise(ends):
        times = np.arange(low, high) / RATE_HZ if stamped else None
        sensor.read(Piece(values[low:high], times), now_s=10.0)
    return sensor


def state(sensor, now_s=10.0, speed=FAST_MPS):
    return sensor.state(now_s, 0, speed)


@given(VALUES, st.lists(st.integers(1, 200)), st.booleans())
def test_counts_are_those_of_the_samples_however_they_come(values, cuts, stamped):
    found = state(fed(values, cuts, stamped=stamped))
    missing = int(np.isnan(values).sum())
    assert (found.samples, found.missing, found.silent_s) == (len(values), missing, 0.0)
    weights = np.exp(np.arange(len(values)) / RATE_HZ / RECENT_S)
    share = weights[np.isnan(values)].sum() / weights.sum()
    # Of samples with times, the first of all has no time since the one before.
    assert found.missing_share == pytest.approx(share, abs=0.01 if stamped else 1e-9)


@given(st.integers(1, 400), st.lists(st.integers(1, 400)), st.booleans())
def test_a_sensor_is_unchanged_for_as_long_as_it_repeats_itself(alike, cuts, stamped):
    values = np.concatenate([np.arange(50.0) + 10.0, np.full(alike, 3.0)])
    found = state(fed(values, cuts, stamped=stamped))
    expected_s = Fraction(alike - 1, 100)
    # Within a piece the samples that changed take the same time as those that did not.
    assert found.unchanged_s == pytest.approx(float(expected_s), abs=0.02)
    sure = alike > STUCK_S * RATE_HZ + 3
    assert found.health is Health.STUCK or not sure
    assert found.health is Health.OK or alike >= STUCK_S * RATE_HZ - 3


def test_a_standstill_and_a_channel_that_may_be_constant_are_not_stuck():
    same = np.full(500, 0.3)
    assert state(fed(same)).health is Health.STUCK
    assert state(fed(same), speed=0.0).health is Health.OK
    assert state(fed(same), speed=None).health is Health.OK
    assert state(fed(same, name="gnss_quality")).health is Health.OK
    few = SensorHealth("left.height", UniformClock.of(1.0))
    few.read(Piece(np.full(STUCK - 1, 0.3)), 0.0)
    assert few.state(0.0, 0, FAST_MPS).health is Health.OK


def test_silence_and_missing_samples_have_names():
    sensor = SensorHealth("distance", None)
    assert state(sensor).health is Health.WAITING
    assert np.isnan(state(sensor).silent_s)
    sensor.read(Piece(np.empty(0), np.empty(0)), 3.0)
    assert state(sensor).health is Health.WAITING
    sensor = fed(np.arange(300.0))
    assert state(sensor, 10.0 + 0.9 * SILENT_S).health is Health.OK
    assert state(sensor, 10.0 + 1.1 * SILENT_S).health is Health.SILENT
    dark = fed([*np.arange(1000.0), *np.full(200, np.nan)])
    assert state(dark).health is Health.MISSING
    assert state(fed([*np.arange(1000.0), *np.full(200, np.nan), *np.arange(300.0)])).health is (
        Health.OK
    )


def test_samples_that_never_come_are_dropped():
    sensor = fed(np.arange(10.0))
    sensor.drop(7)
    sensor.drop(5)
    found = sensor.state(10.0, 3, None)
    assert (found.samples, found.dropped, found.late) == (10, 12, 3)
