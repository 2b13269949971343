"""Means over nodes: of positions and accelerations alike, and of what is known."""

from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.estimators.road_slope.readings import Drive, Readings, average_thrice

SEEDS = st.integers(0, 2**32 - 1)
EVERY = st.integers(1, 9)
STEP = 0.005


def drive(count: int, **changed: Any) -> Drive:
    """Return a drive whose readings are drawn, but for those that are ``changed``."""
    rng = np.random.default_rng(count)
    force, height, speed, along = rng.normal(size=(4, count))
    never = np.zeros(count, np.bool_)
    usual = Drive(force, never, height, np.arange(count) / 10, speed, along, never, STEP)
    return usual._replace(**changed)


@given(seed=SEEDS, every=EVERY, nodes=st.integers(3, 12))
def test_second_differences_of_mean_positions_are_the_averaged_accelerations(
    seed: int, every: int, nodes: int
) -> None:
    """Of any motion, with the acceleration of a bin from its two neighbours."""
    position = np.random.default_rng(seed).normal(size=nodes * every + 2)
    acceleration = np.diff(position, 2) / STEP**2
    mean = position[1:-1].reshape(nodes, every).mean(axis=1)
    expected = np.diff(mean, 2) / (every * STEP) ** 2
    found = average_thrice(acceleration, every)
    assert found.size == nodes
    np.testing.assert_allclose(found[1:-1], expected, rtol=1e-9, atol=1e-6)


@given(every=EVERY, level=st.floats(-1, 1), slope=st.floats(-1, 1))
def test_a_line_is_averaged_to_its_value_in_the_middle_of_the_bins(
    every: int, level: float, slope: float
) -> None:
    bins = np.arange(6.0 * every)
    middle = bins.reshape(6, every).mean(axis=1)
    found = average_thrice(level + slope * bins, every)
    np.testing.assert_allclose(found[1:-1], (level + slope * middle)[1:-1], atol=1e-12)


def test_a_hat_over_one_node_has_the_shares_of_five_boxes() -> None:
    """It is two boxes wide and high itself; the bins are so short that they are no steps."""
    every = 200
    places = np.arange(5 * every) - 0.5 * (every - 1)
    hat = np.interp(places, every * np.array([1, 2, 3]), [0.0, 1.0, 0.0])
    shares = np.array([1, 76, 230, 76, 1]) / 384
    np.testing.assert_allclose(average_thrice(hat, every), shares, atol=1e-4)


@given(seed=SEEDS, every=EVERY, nodes=st.integers(1, 8), more=st.integers(0, 8))
def test_nodes_have_the_means_of_their_bins_of_what_is_known(
    seed: int, every: int, nodes: int, more: int
) -> None:
    rng, count = np.random.default_rng(seed), nodes * every + min(more, every - 1)
    height = np.where(rng.uniform(size=count) < 0.5, np.nan, rng.normal(size=count))
    lost = rng.uniform(size=count) < 0.3
    whole = drive(count, height=height, missing=lost)
    found = Readings.of(whole, [slice(0, count)], every * STEP)
    assert found.height.size == found.force.size == nodes
    for k in range(nodes):
        bins = np.arange(k * every, (k + 1) * every)
        known = [h for h in height[bins] if not np.isnan(h)]
        expected = sum(known) / len(known) if known else np.nan
        np.testing.assert_allclose(found.height[k], expected, atol=1e-12)
        assert abs(found.missing[k] - lost[bins].mean()) < 1e-12
        assert abs(found.place[k] - bins.mean() / 10) < 1e-12
        assert abs(found.speed[k] - whole.speed[bins].mean()) < 1e-12
        assert abs(found.along[k] - whole.along[bins].mean()) < 1e-12


@given(begin=st.integers(0, 20), sizes=st.lists(st.integers(12, 40), min_size=1, max_size=3))
def test_pieces_are_as_alone_and_pauses_are_the_time_between_their_nodes(
    begin: int, sizes: list[int]
) -> None:
    pieces, end = [], begin
    for size in sizes:
        pieces.append(slice(end, end + size))
        end += size + 50
    whole = drive(end)
    found = Readings.of(whole, pieces, 4 * STEP)
    alone = [Readings.of(whole, [piece], 4 * STEP) for piece in pieces]
    for name in ("bins", "height", "force", "place", "speed", "along"):
        each = np.concatenate([getattr(part, name) for part in alone])
        np.testing.assert_allclose(getattr(found, name), each, rtol=1e-15)
    np.testing.assert_allclose(found.pause_s[1:], np.diff(found.bins) * STEP, rtol=1e-12)
    assert abs(found.pause_s[0] - 4 * STEP) < 1e-12


def nodes_of(pause: np.ndarray, speed: np.ndarray) -> Readings:
    """Return nodes at 0 of which pauses and speeds count."""
    zero = np.zeros(pause.size)
    return Readings(zero, zero, zero, zero, speed, zero, zero, pause, 0.02)


@given(cuts=st.sets(st.integers(1, 11)))
def test_middles_are_the_nodes_with_both_sides(cuts: set[int]) -> None:
    pause = np.full(12, 0.02)
    pause[list(cuts)] += 0.02
    found = nodes_of(pause, np.zeros(12)).middles
    assert set(found.tolist()) == {k for k in range(1, 11) if not {k, k + 1} & cuts}
    assert found.tolist() == sorted(found)


@given(
    moving=st.lists(st.booleans(), min_size=2, max_size=40),
    cuts=st.sets(st.integers(1, 39)),
    least_s=st.sampled_from([0.03, 0.07, 0.11]),
)
def test_a_step_is_rested_where_the_vehicle_has_stood_so_long(
    moving: list[bool], cuts: set[int], least_s: float
) -> None:
    """From the last node in motion on; what was cut of a standstill counts."""
    pause = np.full(len(moving), 0.02)
    pause[[k for k in cuts if k < len(moving)]] = 0.05
    seen = nodes_of(pause, 1.0 * np.array(moving))
    expected = []
    for k in range(1, len(moving)):
        first = max((j + 1 for j in range(k + 1) if moving[j]), default=0)
        expected.append(float(pause[first + 1 : k + 1].sum()) >= least_s)
    assert seen.rested(least_s).tolist() == expected


@given(interval_s=st.floats(0.0, 0.1))
def test_the_interval_is_a_whole_number_of_bins_next_to_that_wanted(interval_s: float) -> None:
    found = Readings.of(drive(100), [slice(0, 100)], interval_s).interval_s
    assert abs(found / STEP - round(found / STEP)) < 1e-9
    assert abs(found - max(interval_s, STEP)) <= STEP / 2 + 1e-12
