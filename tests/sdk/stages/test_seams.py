"""Where the encoder lost travel, or made it up, the road goes on at its grade."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.stages.seams import Seams
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId

RATE, COUNT = 100, 600
REFERENCE, HEIGHT = (ChannelId(n, "left") for n in ("floating_reference_height", "height"))
DISTANCE = ChannelId("distance")
laws = settings(deadline=None, max_examples=25)
SEEDS = st.integers(0, 2**32 - 1)
BEGIN, LENGTH = st.integers(30, 300), st.integers(1, 200)
CUTS = st.lists(st.integers(1, COUNT - 1), max_size=6, unique=True)


def drawn(seed, speed=12.0):
    rng = np.random.default_rng(seed)
    values = {REFERENCE: np.cumsum(rng.normal(size=COUNT)), HEIGHT: rng.normal(size=COUNT)}
    return {**values, DISTANCE: speed / RATE * np.arange(COUNT)}


def through(values, cuts=()):
    header = Header(Axis.TIME, 1 / RATE, 0.0, Fraction(RATE), frozenset(values), ("left",))
    stage, out = Seams(), []
    stage.start(header)
    for begin, end in pairwise([0, *sorted(cuts), COUNT]):
        out.append(stage.push(Block(begin, {c: v[begin:end].copy() for c, v in values.items()})))
    assert stage.finish() == ()
    return join_blocks(out)[REFERENCE]


def lost(values, begin, length, counted_m):
    """Return ``values`` with no distance for a while, of which ``counted_m`` counts."""
    distance = values[DISTANCE].copy()
    distance[begin + length :] += counted_m - (distance[begin + length] - distance[begin - 1])
    distance[begin : begin + length] = np.nan
    return {**values, DISTANCE: distance}


@laws
@given(seed=SEEDS, begin=BEGIN, length=LENGTH, cuts=CUTS)
def test_behind_lost_travel_the_elevation_is_that_before_it(seed, begin, length, cuts):
    values = lost(drawn(seed), begin, length, counted_m=0.0)
    found, end = through(values, cuts), begin + length
    elevation = found - values[HEIGHT]
    assert abs(elevation[end] - elevation[begin - 1]) < 1e-12
    np.testing.assert_array_equal(found[:begin], values[REFERENCE][:begin])
    shift = found[end:] - values[REFERENCE][end:]
    np.testing.assert_allclose(shift, shift[0], atol=1e-12)


def on_a_line(slope, speed=12.0):
    """Return samples on a road of one ``slope``."""
    place = speed / RATE * np.arange(COUNT)
    return {REFERENCE: slope * place, HEIGHT: np.zeros(COUNT), DISTANCE: place}


@laws
@given(
    slope=st.floats(-0.12, 0.12),
    begin=BEGIN,
    length=st.integers(1, 9),
    leap_m=st.floats(2.5, 20.0),
    cuts=CUTS,
)
def test_behind_a_leap_the_road_has_gone_on_at_its_grade(slope, begin, length, leap_m, cuts):
    """What a high-pass over the encoder's distance takes away of a grade leaves no step."""
    true_m = 12.0 / RATE * (length + 1)
    values = lost(on_a_line(slope), begin, length, true_m + leap_m)
    found, place = through(values, cuts), values[DISTANCE]
    known = ~np.isnan(place)
    np.testing.assert_allclose(found[known], slope * place[known], atol=1e-9)


@laws
@given(
    slope=st.floats(-0.12, 0.12), begin=BEGIN, length=LENGTH, share=st.floats(0.0, 0.45), cuts=CUTS
)
def test_travel_that_is_counted_in_part_goes_on_at_the_grade(slope, begin, length, share, cuts):
    values = lost(on_a_line(slope), begin, length, share * 12.0 / RATE * (length + 1))
    found, place = through(values, cuts), values[DISTANCE]
    known = ~np.isnan(place)
    np.testing.assert_allclose(found[known], slope * place[known], atol=1e-9)


@laws
@given(seed=SEEDS, begin=BEGIN, length=LENGTH, cuts=CUTS, more=st.floats(0.6, 2.9))
def test_travel_that_may_be_true_and_standstills_shift_nothing(seed, begin, length, cuts, more):
    moving = drawn(seed)
    true_m = 12.0 / RATE * (length + 1)
    for values in (
        lost(moving, begin, length, more * true_m),
        lost(drawn(seed, speed=0.0), begin, length, 0.0),
    ):
        np.testing.assert_array_equal(through(values, cuts), moving[REFERENCE])


@laws
@given(seed=SEEDS, begin=BEGIN, length=st.integers(11, 200), cuts=CUTS)
def test_too_many_counts_for_long_are_no_leap(seed, begin, length, cuts):
    """The vehicle has travelled meanwhile, by an unknown part of them."""
    moving = drawn(seed)
    values = lost(moving, begin, length, 5.0 * 12.0 / RATE * (length + 1))
    np.testing.assert_array_equal(through(values, cuts), moving[REFERENCE])


@laws
@given(seed=SEEDS, cuts=CUTS, every=st.integers(2, 7))
def test_where_most_samples_are_silent_the_pace_is_still_that_of_the_road(seed, cuts, every):
    values = drawn(seed)
    counted = np.where(np.arange(COUNT) % every == 0, values[DISTANCE], np.nan)
    np.testing.assert_array_equal(through({**values, DISTANCE: counted}, cuts), values[REFERENCE])


@laws
@given(seed=SEEDS, begin=BEGIN, length=LENGTH, cuts=CUTS)
def test_any_split_gives_the_same_bits(seed, begin, length, cuts):
    values = lost(drawn(seed), begin, length, seed % 3 * 5.0)
    values[HEIGHT][begin - 1] = np.nan if seed % 2 else 0.0
    np.testing.assert_array_equal(through(values, cuts), through(values))


def test_a_seam_between_two_blocks_is_one_within_a_block() -> None:
    values = lost(drawn(0), 200, 100, counted_m=0.0)
    whole = through(values)
    assert (whole != values[REFERENCE])[300:].all()
    np.testing.assert_array_equal(through(values, [300]), whole)
