"""What spoils a recording changes what it names by as much as it says, and nothing else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.mutants import recordings as r

RATE, COUNT = 1000.0, 10000
TIMES = np.arange(COUNT) / RATE
FORCE = STANDARD_GRAVITY + 2.0 * np.sin(TIMES)
HEIGHT = 0.28 + 0.01 * np.cos(3.0 * TIMES)
DISTANCE = 20.0 * TIMES


def recorded(start_s=0.0, **changes):
    values = {r.FORCE: FORCE, r.HEIGHT: HEIGHT, r.DISTANCE: DISTANCE, **changes}
    clock = UniformClock.of(RATE, start_s)
    tracks = {r.FORCE: "left", r.HEIGHT: "left"}
    return Recording(tuple(Channel.of(n, v, clock, tracks.get(n)) for n, v in values.items()))


def values(recording, name):
    return recording.channel(name, "left").values


CHANGES = {
    "held": (r.HEIGHT, r.hold_first, np.full(COUNT, HEIGHT[0])),
    "at rest": (r.FORCE, r.replace_by_rest, np.full(COUNT, STANDARD_GRAVITY)),
    "mirrored": (r.HEIGHT, r.mirror, 2 * HEIGHT[0] - HEIGHT),
    "upside down": (r.FORCE, r.invert_acceleration, STANDARD_GRAVITY - 2.0 * np.sin(TIMES)),
    "scaled": (r.HEIGHT, r.scale(1.01), 1.01 * HEIGHT),
    "shaken": (r.FORCE, r.scale_acceleration(0.5), STANDARD_GRAVITY + np.sin(TIMES)),
    "clipped": (
        r.FORCE,
        r.clip(1.0),
        np.clip(FORCE, STANDARD_GRAVITY - 1, STANDARD_GRAVITY + 1),
    ),
    "late": (r.HEIGHT, r.delay_by(0.002), np.append([HEIGHT[0]] * 2, HEIGHT[:-2])),
}


@pytest.mark.parametrize("name", CHANGES)
def test_one_channel_is_changed_as_said(name):
    channel, change, expected = CHANGES[name]
    sound = recorded()
    spoilt = r.change_channel(channel, change)(sound)
    for other in (r.FORCE, r.HEIGHT, r.DISTANCE):
        wanted = expected if other == channel else values(sound, other)
        assert np.allclose(values(spoilt, other), wanted, rtol=0, atol=1e-12)


@settings(deadline=None, max_examples=10)
@given(every=st.integers(2, 5000))
def test_one_of_so_many_samples_is_lost(every):
    spoilt = values(r.change_channel(r.DISTANCE, r.lose_samples(every))(recorded()), r.DISTANCE)
    taken = np.round(spoilt * RATE / 20.0).astype(int)
    lost = np.setdiff1d(np.arange(taken.max()), taken)
    assert np.array_equal(lost, np.arange(every - 1, taken.max(), every))


def test_missing_samples_get_a_value():
    height = np.where(np.arange(COUNT) % 100 < 10, np.nan, HEIGHT)
    spoilt = r.change_channel(r.HEIGHT, r.fill_missing(0.0))(recorded(**{r.HEIGHT: height}))
    filled = values(spoilt, r.HEIGHT)
    missing = np.isnan(height)
    assert np.array_equal(filled[~missing], height[~missing])
    assert np.abs(filled[missing]).max() <= r.JITTER
    assert not (np.diff(filled) == 0.0).any()


def test_gaps_are_bridged_by_straight_lines():
    gap = slice(100, 200)
    height = HEIGHT.copy()
    height[gap] = np.nan
    spoilt = values(r.bridge_missing(recorded(**{r.HEIGHT: height})), r.HEIGHT)
    assert np.allclose(np.diff(spoilt[99:201], 2), 0.0, atol=1e-12)
    assert np.array_equal(np.delete(spoilt, np.r_[gap]), np.delete(HEIGHT, np.r_[gap]))


def test_times_in_single_precision_do_no_harm_near_their_origin_alone():
    near = values(r.round_times(recorded()), r.DISTANCE)
    far = values(r.round_times(recorded(start_s=1e5)), r.DISTANCE)
    assert np.array_equal(near, DISTANCE)
    assert np.abs(far - DISTANCE).max() > 0.05
