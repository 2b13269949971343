"""What is observed when: by the times of readings, stops and sub-blocks alone."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.observations import join_observations, part
from floatref.estimators.kalman.references import Plan, References, Stretch
from floatref.estimators.models.kalman_values import (
    CAPTURE,
    FORGET,
    HEIGHT,
    KINDS,
    PITCH,
    REFLECTED,
    RELATIVE,
    RENEW,
    TRUSTED,
    VELOCITY,
)

LENGTH, SUB_BLOCK, STEP = 400, 5, 0.01
PATIENCE = 50
NOISE = Noise()
laws = settings(deadline=None, max_examples=60)


def spans(count):
    """Draw up to ``count`` pairs of a first sample and how many there are."""
    return st.lists(
        st.tuples(st.integers(0, LENGTH - 1), st.integers(1, 120)), max_size=count, unique=True
    )


def within(pairs):
    mask = np.zeros(LENGTH, bool)
    for begin, count in pairs:
        mask[begin : begin + count] = True
    return mask


@st.composite
def stretches(draw):
    """A run of 4 s: stops, height sensor and GNSS out of order at times."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    every = draw(st.sampled_from([1, 4, 7, 30]))
    lost = within(draw(spans(3)))
    taken = np.flatnonzero((np.arange(LENGTH) % every == 0) & ~lost)
    readings = np.hstack([rng.normal(size=(taken.size, 4)), np.full((taken.size, 1), 0.05)])
    readings[:, 1:4][rng.uniform(size=(taken.size, 3)) < 0.1] = np.nan
    height = rng.normal(size=LENGTH)
    quiet = np.array(sorted(draw(st.sets(st.integers(0, LENGTH - 1), max_size=2))), np.int64)
    standing, there = within(draw(spans(3))), ~within(draw(spans(2)))
    return Stretch(0, standing, height, there, taken, readings, quiet)


PLANS = st.builds(Plan, gnss=st.booleans(), attitude=st.booleans(), reflects=st.booleans())
RUNS = stretches()
MOVING, THERE = np.zeros(LENGTH, bool), np.ones(LENGTH, bool)
SELDOM = Stretch(
    0,
    MOVING,
    np.zeros(LENGTH),
    THERE,
    np.array([0, 150, 300]),
    np.full((3, 5), 0.05),
    np.empty(0, np.int64),
)


def scheduled(plan, stretch, cuts=()):
    """Return all observations, from a run cut at ``cuts``."""
    references = References(plan, NOISE, SUB_BLOCK, STEP, 0.3, 1.6)
    edges = [0, *sorted(set(cuts)), LENGTH]
    return join_observations([references.schedule(stretch.part(a, b)) for a, b in pairwise(edges)])


@pytest.mark.slow
@laws
@given(plan=PLANS, stretch=RUNS, cuts=st.sets(st.integers(1, LENGTH - 1), max_size=6))
@example(plan=Plan(reflects=False), stretch=SELDOM, cuts={90, 240})
def test_it_does_not_matter_how_the_run_is_split(plan, stretch, cuts):
    """Among the cuts are those one sample behind the beginning of a stop, or of motion."""
    edges = np.flatnonzero(np.diff(stretch.standing)) + 2
    cuts = cuts.union(edges[edges < LENGTH].tolist()[: len(cuts)])
    whole, split = scheduled(plan, stretch), scheduled(plan, stretch, cuts)
    for one, other in zip(whole, split, strict=True):
        np.testing.assert_array_equal(one, other)


@laws
@given(plan=PLANS, stretch=RUNS)
def test_samples_are_in_order_and_there_is_one_observation_at_each(plan, stretch):
    found = scheduled(plan, stretch)
    assert (np.diff(found.at) > 0).all()
    assert len({len(values) for values in found}) == 1
    assert ((found.at >= 0) & (found.at < LENGTH)).all()
    assert (found.variances[~np.isnan(found.values)] > 0).all()
    assert (found.drifted >= 0).all()


def observed_at(schedule, wanted):
    place = np.searchsorted(schedule.at, wanted)
    np.testing.assert_array_equal(schedule.at[place], wanted)
    return part(schedule, place)


@pytest.mark.slow
@laws
@given(stretch=RUNS)
def test_every_reading_is_observed_and_its_height_unless_the_vehicle_stands(stretch):
    found = observed_at(scheduled(Plan(), stretch), stretch.taken)
    np.testing.assert_array_equal(found.values[:, VELOCITY:], stretch.readings[:, VELOCITY:KINDS])
    moving = ~stretch.standing[stretch.taken]
    expected = stretch.readings[:, 0] - stretch.readings[:1, 0] + 1.6 + 0.3
    np.testing.assert_allclose(found.values[moving, HEIGHT], expected[moving], atol=1e-12)
    assert not (found.marks & (RELATIVE | CAPTURE)).any()
    assert not (found.marks[moving] & (TRUSTED | REFLECTED | RENEW)).any()


@laws
@given(stretch=RUNS, attitude=st.booleans())
def test_a_level_attitude_comes_with_every_reading_if_gnss_gives_none(stretch, attitude):
    plan = Plan(attitude=attitude, reflects=False)
    found = observed_at(scheduled(plan, stretch), stretch.taken)
    if attitude:
        np.testing.assert_array_equal(found.values[:, PITCH:], stretch.readings[:, PITCH:KINDS])
    else:
        assert not found.values[:, PITCH:].any()
        np.testing.assert_allclose(found.variances[:, PITCH], NOISE.constant_pitch**2 / 0.05)


@laws
@given(stretch=RUNS, interval_s=st.floats(0.001, 0.2))
def test_readings_say_no_more_for_coming_faster(stretch, interval_s):
    """Variance times rate is bounded by that of 20 readings a second."""
    stretch.readings[:, 4] = interval_s
    found = observed_at(scheduled(Plan(reflects=False), stretch), stretch.taken).variances
    least = NOISE.readings() * max(1.0, 0.05 / interval_s * (interval_s < 0.045))
    np.testing.assert_allclose(found, np.broadcast_to(least, found.shape))


@laws
@given(stretch=RUNS, reflects=st.booleans())
def test_constants_stand_in_half_a_second_after_the_last_reading(stretch, reflects):
    at, marks, values, *_ = scheduled(Plan(reflects=reflects), stretch)
    held = (marks & RELATIVE) > 0
    before = np.concatenate(([0], stretch.taken))
    samples = np.arange(LENGTH)
    waited = samples - before[np.searchsorted(before, samples, "right") - 1]
    wanted = (waited >= PATIENCE) & (samples % SUB_BLOCK == 0) & ~np.isin(samples, stretch.taken)
    np.testing.assert_array_equal(at[held], samples[wanted])
    assert (marks[held] & TRUSTED).all()
    assert not values[held, VELOCITY:].any()
    moving = ~stretch.standing[at] | (not reflects)
    assert not values[held & moving, HEIGHT].any()


@laws
@given(stretch=RUNS)
@example(stretch=SELDOM)
def test_every_outage_captures_a_height_once_and_ends_with_another_datum(stretch):
    at, marks, _, _, drifted = scheduled(Plan(reflects=False), stretch)
    outage = -1
    for sample, mark, moved in zip(at, marks, drifted, strict=True):
        if mark & RELATIVE:
            assert bool(mark & CAPTURE) == (outage < 0)
            outage = sample
        elif sample in stretch.taken:
            assert moved >= 100.0**2 or outage < 0
            outage = -1


@pytest.mark.slow
@laws
@given(stretch=RUNS)
def test_the_drift_walks_for_all_of_the_time_between_two_heights(stretch):
    at, _, _, _, drifted = scheduled(Plan(), stretch)
    heights = np.isin(at, stretch.taken) & ~stretch.standing[at]
    elapsed = np.diff(at[heights], prepend=0) * STEP
    walk = drifted[heights]
    renewed = walk >= 100.0**2
    np.testing.assert_allclose(walk[~renewed], NOISE.gnss_height_walk**2 * elapsed[~renewed])
    assert not drifted[~heights].any()
    assert (elapsed[renewed] > PATIENCE * STEP).all()


@pytest.mark.cites("(6.58)", "(6.60)")
@laws
@given(stretch=RUNS)
def test_at_a_stop_the_height_sensor_tells_the_way_since_it_began(stretch):
    at, marks, values, variances, _ = scheduled(Plan(), stretch)
    reflected = (marks & REFLECTED) > 0
    samples = np.arange(LENGTH)
    wanted = stretch.standing & stretch.there & (samples % SUB_BLOCK == 0)
    np.testing.assert_array_equal(at[reflected], samples[wanted])
    assert (marks[reflected] & TRUSTED).all()
    variance = NOISE.reflection**2 / (SUB_BLOCK * STEP)
    np.testing.assert_allclose(variances[reflected, HEIGHT], variance)
    for begin, end in stops(stretch.standing):
        inside = np.flatnonzero(reflected & (at >= begin) & (at < end))
        expected = stretch.height[at[inside]] - stretch.height[at[inside[:1]]]
        np.testing.assert_allclose(values[inside, HEIGHT], expected)
        assert ((marks[inside] & RENEW) > 0).tolist() == [k == 0 for k in range(inside.size)]
    assert ((marks & RENEW) > 0).sum() <= len(stops(stretch.standing))


def stops(standing):
    edges = np.flatnonzero(np.diff(np.concatenate(([0], standing, [0]))))
    return edges.reshape(-1, 2).tolist()


@laws
@given(stretch=RUNS, plan=PLANS)
def test_the_lean_is_forgotten_at_a_constant_speed_and_nothing_else_there(stretch, plan):
    found = scheduled(plan, stretch)
    moving = ~(stretch.standing[stretch.quiet] & plan.reflects)
    forgotten = (found.marks & FORGET) > 0
    np.testing.assert_array_equal(found.at[forgotten], stretch.quiet[moving])
    other = scheduled(plan, stretch.__class__(**{**vars(stretch), "quiet": np.empty(0, int)}))
    kept = np.isin(found.at, other.at)
    assert forgotten[~kept].all()
    for field in ("values", "variances", "drifted"):
        np.testing.assert_array_equal(getattr(found, field)[kept], getattr(other, field))
    assert np.isnan(found.values[~kept]).all()
