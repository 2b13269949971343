"""Integration, sums and the search for points."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from floatref.kernels import motion
from floatref.kernels.memories import INTEGRATOR, SUM
from floatref.values.arrays import new_record
from floatref_reference.chapter_5 import section_5_3, section_5_8

SIGNALS = hnp.arrays(np.float64, st.integers(1, 60), elements=st.floats(-1e3, 1e3, width=32))


@settings(deadline=None, max_examples=40)
@given(x=SIGNALS, rate=st.floats(10.0, 2e4), start=st.floats(-10, 10))
def test_integration_in_time_is_the_trapezoidal_rule(x, rate, start):
    y, memory = np.empty(x.size), new_record(INTEGRATOR)
    memory.total = start
    motion.integrate(x, y, memory, 0.5 / rate)
    expected = section_5_3.trapezoidal_rule(x, 1.0 / rate, start)
    assert np.abs(y - expected).max() <= 1e-12 * (1.0 + np.abs(expected).max())


@pytest.mark.cites("(5.5)")
@settings(deadline=None, max_examples=40)
@given(x=SIGNALS, data=st.data())
def test_integration_over_triggers_is_5_5(x, data):
    steps = data.draw(hnp.arrays(np.float64, x.size, elements=st.floats(0.0, 20.0)))
    y = np.empty(x.size)
    motion.integrate_steps(x, y, new_record(INTEGRATOR), steps)
    expected = section_5_8.velocity(x, steps)
    assert np.abs(y - expected).max() <= 1e-12 * (1.0 + np.abs(expected).max())


@pytest.mark.cites("(5.5)", "(5.6)")
def test_the_example_of_section_5_8():
    g = 9.80665
    acceleration = np.array([-0.01865 * g, 0.00910 * g])
    steps = np.array([0.0, 10.7643])
    velocity, height = np.empty(2), np.empty(2)
    start = new_record(INTEGRATOR)
    start.total = -0.00319
    motion.integrate_steps(acceleration, velocity, start, steps)
    motion.integrate_steps(velocity, height, new_record(INTEGRATOR), steps)
    assert velocity[1] == pytest.approx(-0.50744, abs=2e-4)
    assert height[1] == pytest.approx(-2.748, abs=1e-3)


@settings(deadline=None, max_examples=60)
@given(x=hnp.arrays(np.float64, st.integers(0, 40), elements=st.floats(-1e12, 1e12)))
@example(x=np.array([2**39 + 0.125, 2**39 + 0.125, 2**-13, 1e-245]))
def test_a_sum_and_its_rest_are_exact_to_thirty_digits(x):
    memory = new_record(SUM)
    motion.add_up(x, memory)
    exact = sum((Fraction(float(value)) for value in x), Fraction(0))
    size = sum((abs(Fraction(float(value))) for value in x), Fraction(0))
    found = Fraction(float(memory.total)) + Fraction(float(memory.rest))
    assert abs(found - exact) <= Fraction(1, 10**28) * size
    assert memory.count == x.size


@settings(deadline=None, max_examples=80)
@given(
    counts=st.lists(st.integers(0, 60), min_size=1, max_size=50),
    count_m=st.sampled_from([0.0003, 0.001, 0.00508, 0.02]),
    interval=st.sampled_from([0.00508, 0.01, 0.003, 0.25]),
)
def test_points_lie_where_the_reference_puts_them(counts, count_m, interval):
    distance = 3.0 + count_m * np.cumsum(counts)
    wide = np.concatenate((distance[:1], distance))
    room = int((distance[-1] - distance[0]) / interval) + 2
    sample, part = np.empty(room, np.int64), np.empty(room)
    found = motion.find_points(wide, distance[0], interval, 0, sample, part)
    expected = section_5_3.trigger(distance, interval)
    assert found == len(expected)
    assert [index + 1 for index, _ in expected] == sample[:found].tolist()
    fractions = [float(fraction) for _, fraction in expected]
    np.testing.assert_allclose(part[:found], fractions, rtol=0, atol=1e-9)


def test_a_point_on_a_count_belongs_to_that_count():
    interval, counts = 0.00508, np.arange(2000)
    distance = counts * 0.000254
    sample, part = np.empty(200, np.int64), np.empty(200)
    found = motion.find_points(distance, 0.0, interval, 1, sample, part)
    np.testing.assert_array_equal(sample[:found], 20 * np.arange(1, found + 1))
    assert (part[:found] == 1.0).all()
    assert found == 99


def test_reading_between_samples_is_linear():
    y = np.empty(3)
    sample, part = np.array([0, 1, 2]), np.array([1.0, 0.5, 0.25])
    motion.read_at(1.0, np.array([3.0, 7.0]), sample, part, y)
    assert y.tolist() == [1.0, 2.0, 4.0]


@settings(deadline=None, max_examples=60)
@given(seed=st.integers(0, 2**32 - 1), size=st.integers(2, 40), pending=st.integers(0, 31))
def test_a_point_has_the_flags_of_its_samples_and_what_lasts_of_those_between(seed, size, pending):
    rng, lasting = np.random.default_rng(seed), 0b01110
    flags = rng.integers(0, 32, size).astype(np.uint8)
    samples = np.sort(rng.integers(1, size, rng.integers(0, size)))
    part = rng.choice([0.25, 1.0], samples.size)
    gathered = np.empty(samples.size, np.uint8)
    left = motion.gather_flags(flags, samples, part, lasting, pending & lasting, gathered)
    waiting, before = pending & lasting, 0
    for at, share, found in zip(samples, part, gathered, strict=True):
        waiting |= int(np.bitwise_or.reduce(flags[before + 1 : at + 1], initial=0)) & lasting
        # Between two samples the point is interpolated, and has the flags of both.
        own = flags[at] if share == 1.0 else flags[at] | flags[at - 1]
        assert found == own | waiting
        waiting, before = 0, at
    waiting |= int(np.bitwise_or.reduce(flags[before + 1 :], initial=0)) & lasting
    assert left == waiting
