"""A part of a recording lies where it lay in the whole."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.engine.axis_place import Place, distance_at, first_point, offset_at, point_number
from floatref.engine.run import run
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording


@given(st.floats(-1e6, 1e6), st.sampled_from([0.00508, 0.025, 0.1, 1.0]))
def test_the_first_point_is_the_first_multiple_that_is_not_before(distance_m, interval_m):
    point = first_point(distance_m, interval_m)
    assert point == point_number(distance_m, interval_m) * interval_m
    assert -1e-8 * interval_m - 1e-9 <= point - distance_m < interval_m * (1.0 + 1e-8) + 1e-9


@given(st.integers(-(10**7), 10**7), st.sampled_from([0.00508, 0.025, 0.1]))
def test_a_distance_on_a_point_is_that_point(number, interval_m):
    assert point_number(number * interval_m, interval_m) == number


def shifted(recording, by_m):
    moved = [
        Channel(c.id, c.values + by_m, c.clock) if c.id.name == "distance" else c
        for c in recording.channels
    ]
    return Recording(tuple(moved), recording.setup)


@pytest.mark.parametrize("at_s", [-np.inf, 0.0, 1.37, 4.0])
def test_a_corrected_part_is_moved_to_its_place_and_nothing_else(steady, at_s):
    recorded = steady()
    corrected = shifted(recorded, -0.75)
    placed = Place(at_s, 12.5).move(recorded, corrected)
    assert offset_at(recorded, placed, at_s) == pytest.approx(12.5, abs=1e-12)
    assert placed.channel("height") is corrected.channel("height")


def test_a_part_that_is_in_its_place_is_not_touched(steady):
    recording = steady()
    assert Place(1.0).move(recording, recording) is recording


def test_a_missing_distance_is_read_between_its_neighbours(steady):
    distance = 20.0 * np.arange(4000) / 1000.0
    distance[1000:1500] = np.nan
    assert distance_at(steady(distance=distance), 1.2) == pytest.approx(24.0)
    assert np.isnan(distance_at(steady(distance=np.full(4000, np.nan)), 1.0))


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", ["temporal-basic", "spatial-hpf", "road-prior-smoother"])
def test_the_points_of_a_placed_run_are_multiples_of_the_interval(steady, pipeline):
    recording = shifted(steady(seconds=10.0), 7.013)
    whole, placed = run(recording, pipeline), run(recording, pipeline, place=Place(-np.inf, 100.0))
    assert whole.profile.start_m == 7.013
    assert placed.profile.start_m == pytest.approx(107.05, abs=1e-9)
    assert placed.profile.length_m == pytest.approx(whole.profile.length_m, abs=0.051)


@given(
    st.integers(1, 400),
    st.integers(0, 2**31),
    st.sampled_from([None, 1.0, 100.0, 333.3]),
    st.one_of(st.floats(-10.0, 500.0), st.sampled_from([-np.inf, np.inf])),
    st.sampled_from([0.0, 0.3, 0.95, 1.0]),
)
def test_a_distance_is_on_the_line_between_the_known_samples_around(
    count, seed, rate_hz, at_s, missing
):
    rng = np.random.default_rng(seed)
    values = np.cumsum(rng.uniform(0.0, 1.0, count))
    values[rng.uniform(size=count) < missing] = np.nan
    clock = UniformClock.of(rate_hz, 0.3) if rate_hz else None
    times = np.cumsum(rng.uniform(0.1, 2.0, count)) if clock is None else clock.times(count)
    channel = Channel.of("distance", values, clock or StampedClock.of(times))
    force = Channel.of("vertical_specific_force", np.zeros(9), UniformClock.of(10.0))
    found = distance_at(Recording((force, channel)), at_s)
    known = ~np.isnan(values)
    if known.any():
        assert found == np.interp(at_s, times[known], values[known])
    else:
        assert np.isnan(found)
