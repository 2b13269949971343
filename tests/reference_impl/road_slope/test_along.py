"""Acceleration by encoders with fine and coarse counts, and how long a jolt lasts."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope.along import (
    fading,
    jolts,
    share_of_encoder,
    sharp_acceleration,
    sharper,
)
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.middles import middles
from floatref_reference.road_slope.symbols import Stretch

C = Constants(interval_s=0.1)
Stopping = Callable[..., Stretch]


def read(stretch: Stretch, **readings: np.ndarray) -> Stretch:
    return stretch._replace(readings=stretch.readings._replace(**readings))


def smoothed(stretch: Stretch) -> Stretch:
    """Let a_k be the mean over five nodes."""
    along = np.pad(stretch.readings.along, 2, mode="edge")
    return read(stretch, along=np.convolve(along, np.ones(5) / 5, "valid"))


def second(x: np.ndarray) -> np.ndarray:
    return np.diff(x, 2) / C.interval_s**2


def test_an_encoder_without_counts_is_followed_to_the_end_of_the_brake(stopping: Stopping) -> None:
    """Over most of it both agree, and the end is as sharp as places are."""
    stretch = smoothed(stopping(C))
    assert share_of_encoder(stretch) == pytest.approx(1)
    x = stretch.readings.place
    assert sharp_acceleration(stretch)[1:-1] == pytest.approx(second(x))
    assert np.abs(sharper(stretch)[1:-1]).max() > 0.3


@settings(deadline=None, max_examples=25)
@given(counts=st.floats(1e-6, 1e-2))
def test_the_share_is_that_of_the_counts(stopping: Stopping, counts: float) -> None:
    """Places that are off by plus and minus as much have D_k(x) off by 4/Δ² of it."""
    stretch = stopping(C, K=16)
    off = counts * (-1.0) ** np.arange(16)
    coarse = read(stretch, place=stretch.readings.place + off)
    nu = 1.4826 * 4 * counts / 0.01
    share = 1 / (1 + (nu / 0.1) ** 2)
    assert share_of_encoder(coarse) == pytest.approx(share, rel=1e-6)
    expected = -2 + share * 4 * counts / 0.01 * -((-1.0) ** np.arange(1, 15))
    assert sharp_acceleration(coarse)[1:-1] == pytest.approx(expected, abs=1e-6)


def test_coarse_counts_leave_the_smooth_acceleration(stopping: Stopping) -> None:
    stretch = smoothed(stopping(C))
    coarse = read(stretch, place=np.round(stretch.readings.place / 0.05) * 0.05)
    a = stretch.readings.along
    mean = (a[:-2] + 10 * a[1:-1] + a[2:]) / 12
    assert sharp_acceleration(coarse)[1:-1] == pytest.approx(mean, abs=0.03)


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 99))
def test_what_does_not_move_says_nothing_of_the_counts(stopping: Stopping, seed: int) -> None:
    """Below 0.5 m/s no node has a part in it."""
    stretch = stopping(C, K=30)
    off = np.random.default_rng(seed).normal(size=30) * (np.arange(30) > 19)
    rough = read(stretch, place=stretch.readings.place + off)
    assert share_of_encoder(rough) == pytest.approx(1)
    still = read(rough, speed=np.full(30, 0.49), place=1e-2 * off)
    assert share_of_encoder(still) == 1
    assert sharp_acceleration(still)[1:-1] == pytest.approx(second(1e-2 * off))


def test_nodes_without_neighbours_have_no_acceleration(stopping: Stopping) -> None:
    stretch = stopping(C, cut=9)
    there = np.flatnonzero(~np.isnan(sharp_acceleration(stretch)))
    assert list(there) == middles(stretch)


def test_the_end_of_a_brake_is_a_jolt_that_fades(stopping: Stopping) -> None:
    """It ends at node 20, by 2 m/s²; three nodes before and behind have all of it."""
    k = np.arange(30)
    fades = np.where(k < 20, 0, 2 * np.exp(-0.1 * (k - 20) / 0.5))
    assert fading(stopping(C)) == pytest.approx(fades)
    expected = np.where(k < 17, 0, 2 * np.exp(-0.1 * np.maximum(k - 23, 0) / 0.5))
    assert jolts(stopping(C)) == pytest.approx(expected)


def test_changes_add_up(stopping: Stopping) -> None:
    stretch = read(stopping(C, K=5), along=np.array([0, 1, -1, 0, 0.0]))
    e = np.exp(-0.2)
    assert fading(stretch) == pytest.approx([0, 1, e + 2, e * (e + 2) + 1, e**2 * (e + 2) + e])


def test_a_change_beyond_a_cut_is_no_jolt(stopping: Stopping) -> None:
    assert not jolts(stopping(C, cut=20)).any()
    assert not fading(stopping(C, cut=25))[25:].any()
