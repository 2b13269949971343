"""A laser that is stuck or out of its range is found where it is, and nowhere else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.damage.stuck_sensors import find_stuck_height
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

G, RATE, COUNT, SPEED = 9.80665, 4000.0, 16_000, 20.0
CLOCK = UniformClock.of(RATE)
TIMES = np.arange(COUNT) / RATE
FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
laws = settings(deadline=None, max_examples=25)


def forces(noise=0.3):
    return G + noise * np.random.default_rng(0).standard_normal(COUNT)


def swung(heave=0.01):
    """What an accelerometer reads while the body heaves at 1.5 Hz by so much either way."""
    return forces(0.05) - heave * (3.0 * np.pi) ** 2 * np.sin(3.0 * np.pi * TIMES)


def heights(seed=0, quantum=4e-6, hold=1):
    rng = np.random.default_rng(seed)
    values = 0.3 + 0.005 * np.sin(np.arange(COUNT) / 300.0) + 5e-5 * rng.standard_normal(COUNT)
    return np.repeat(quantum * np.round(values[::hold] / quantum), hold)[:COUNT]


def of_height(values, force=None, distance=None):
    return find_stuck_height(
        Channel.of(HEIGHT, values, CLOCK),
        Channel.of(FORCE, forces() if force is None else force, CLOCK),
        Channel.of(DISTANCE, SPEED * TIMES if distance is None else distance, CLOCK),
    )


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(1, 8000),
    length=st.integers(220, 4000),
    hold=st.sampled_from([1, 2, 5]),
)
def test_a_stuck_laser_is_found(seed, at, length, hold):
    values = heights(seed, hold=hold)
    values[at : at + length] = 0.2987654
    np.testing.assert_array_equal(of_height(values).gone, [[at, at + length]])


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(0, 4000),
    length=st.integers(8800, COUNT),
    quantum=st.sampled_from([4e-6, 1e-4, 5e-4]),
)
def test_a_laser_stuck_for_most_of_the_run_is_found(seed, at, length, quantum):
    """The fault does not make itself usual; it may last to the end."""
    values = heights(seed, quantum)
    values[at : at + length] = values[at]
    (found,) = of_height(values, swung()).gone
    assert found[0] <= at
    assert found[1] >= min(at + length, COUNT)
    assert np.ptp(values[slice(*found)]) == 0.0


@laws
@given(length=st.integers(400, 1200), quantum=st.sampled_from([4e-6, 1e-4]))
def test_a_laser_that_sticks_over_and_over_is_found(length, quantum):
    """Stuck for most of the run, in many places: the body heaves, and it leaves by leaps."""
    values, stuck = heights(quantum=quantum), np.zeros(COUNT, bool)
    for at in range(100, COUNT - 1400, 1400):
        values[at : at + length] = 0.31 + quantum * np.round(1e-3 * np.sin(at) / quantum)
        stuck[at : at + length] = True
    found = np.zeros(COUNT, bool)
    for first, behind in of_height(values, swung()).gone:
        found[first:behind] = True
    np.testing.assert_array_equal(found, stuck)


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(1, 8000),
    length=st.integers(40, 4000),
    far=st.sampled_from([-0.1, 0.15]),
)
def test_a_laser_out_of_its_range_is_found(seed, at, length, far):
    values = heights(seed, hold=2)
    values[at : at + length] = 0.3 + far
    np.testing.assert_array_equal(of_height(values).gone, [[at, at + length]])


@pytest.mark.parametrize(
    "values",
    [
        heights(hold=5),
        heights(quantum=5e-4),
        np.where(np.arange(COUNT) % 4000 < 2000, 0.3, 0.295),
        heights(quantum=4e-6, hold=400),
    ],
    ids=["held", "coarse", "plate", "slow"],
)
def test_a_laser_that_repeats_itself_anyway_is_not_suspected(values):
    assert of_height(values).gone.size == 0


@laws
@given(
    seed=st.integers(0, 99),
    quantum=st.sampled_from([1e-4, 2.5e-4, 5e-4]),
    noise=st.sampled_from([0.0, 1e-5, 5e-5]),
    distance=st.sampled_from([SPEED * TIMES, 0.1 * TIMES]),
)
def test_a_coarse_laser_over_a_flat_floor_is_not_stuck(seed, quantum, noise, distance):
    """A parked vehicle with its engine on, and an artificial encoder."""
    rng = np.random.default_rng(seed)
    shake = 1e-5 * np.sin(2 * np.pi * 26.0 * TIMES)
    values = 0.3 + rng.uniform(0, quantum) + shake + noise * rng.standard_normal(COUNT)
    values[9000:9400] += 0.025
    force = forces(0.1) - (2 * np.pi * 26.0) ** 2 * shake
    assert of_height(quantum * np.round(values / quantum), force, distance).gone.size == 0


def test_a_constant_laser_is_either_refused_or_told():
    """Over a flat floor it may be sound, which nobody but the user knows."""
    constant = np.full(COUNT, 0.3)
    np.testing.assert_array_equal(of_height(constant, swung()).gone, [[0, COUNT]])
    over_a_floor = of_height(constant)
    assert over_a_floor.gone.size == 0
    (line,) = over_a_floor.warnings
    assert "channel height: repeats itself for most of the run" in line
    assert of_height(constant, None, np.minimum(SPEED * TIMES, 1e-9)).warnings == ()


def test_a_laser_is_not_stuck_while_nothing_moves():
    values, still, stop = heights(), forces(), SPEED * TIMES
    values[6000:9000] = values[6000]
    still[5990:9010] = G
    stop[5990:9010] = stop[5990]
    assert of_height(values).gone.size == 2
    assert of_height(values, still).gone.size == 0
    assert of_height(values, None, stop).gone.size == 0


@laws
@given(
    at=st.integers(1, 8000),
    length=st.integers(4000, 7000),
    quantum=st.sampled_from([4e-6, 1e-4, 5e-4]),
    hold=st.sampled_from([1, 5]),
)
def test_a_laser_is_stuck_while_a_standing_body_heaves(at, length, quantum, hold):
    """As where it comes to rest after a brake; a hold of less than a second may be its own."""
    values, stop = heights(quantum=quantum, hold=hold), np.zeros(COUNT)
    values[at : at + length] = 0.2987654
    np.testing.assert_array_equal(of_height(values, swung(), stop).gone, [[at, at + length]])
    values = heights(quantum=quantum, hold=hold)
    values[at : at + 3500] = 0.2987654
    assert of_height(values, swung(), stop).gone.size == 0


@pytest.mark.parametrize("quantum", [1e-4, 2.5e-4])
def test_a_coarse_laser_is_not_stuck_at_a_stop(quantum):
    rng, stands = np.random.default_rng(0), (TIMES > 1.0) & (TIMES < 3.0)
    values = 0.3 + 0.005 * np.cumsum(np.where(stands, 0.0, rng.standard_normal(COUNT))) / 60.0
    values = quantum * np.round(values / quantum)
    travelled = SPEED * np.cumsum(~stands) / RATE
    assert of_height(values, None, travelled).gone.size == 0
    assert of_height(values).gone.size == 2


@pytest.mark.parametrize("at", [slice(0, 40), slice(COUNT - 40, COUNT), slice(800, 840)])
def test_an_end_of_the_samples_is_no_leap(at):
    """Forty equal samples at the greatest of all, entered and left by no more than noise."""
    values = heights()
    values[at] = values.max() + 4e-6
    values[790:800], values[840:850] = np.nan, np.nan
    assert of_height(values).gone.size == 0
    values[at] += 0.1
    beside_missing = at.start == 800
    assert of_height(values).gone.size == (0 if beside_missing else 2)


def test_an_accelerometer_of_its_own_clock_is_looked_at_in_the_same_time():
    values, moved = heights(), forces()
    values[6000:9000] = values[6000]
    times = 100.0 + TIMES
    late = Channel.of(HEIGHT, values, StampedClock.of(times))
    for clock in (UniformClock.of(RATE, 100.0), StampedClock.of(times)):
        distance = Channel.of(DISTANCE, SPEED * TIMES, clock)
        assert find_stuck_height(late, Channel.of(FORCE, moved, clock), distance).gone.size == 2
        still = np.where((times > 101.4) & (times < 102.3), G, moved)
        assert find_stuck_height(late, Channel.of(FORCE, still, clock), distance).gone.size == 0
