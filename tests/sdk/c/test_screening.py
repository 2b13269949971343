"""Screening in C finds the gaps, stays and spikes that the SDK finds in whole recordings."""

from itertools import pairwise

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.intake.height_gaps import height_gaps
from floatref.screening.damage.damaged_samples import Usual
from floatref.screening.damage.spikes import UNUSUAL, find_spikes
from floatref.screening.damage.stuck_sensors import find_stuck_force, find_stuck_height
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref.values.scan import Scan

RATE, COUNT_M, LENGTH = 1000.0, 2.0**-10, 3000
COUNTS = 10
"""A sample: half a metre is 51.2 samples."""
GAP, STUCK, OUT_OF_RANGE, SPIKE = 1, 2, 3, 4
NOTHING = np.empty((0, 2), np.int64)


def drive(seed, faults):
    """Return height, force and counts, and the channels, with the ``faults`` in the height."""
    rng = np.random.default_rng(seed)
    height, force = 0.3 + 0.001 * rng.normal(size=LENGTH), 9.8 + rng.normal(size=LENGTH)
    counts = COUNTS * np.arange(LENGTH)
    for kind, first, length in faults:
        height[first : first + length] = np.nan if kind == GAP else height[first]
    clock = UniformClock.of(RATE)
    channels = (
        Channel.of("height", height, clock, "main"),
        Channel.of("vertical_specific_force", force, clock, "main"),
        Channel.of("distance", counts * COUNT_M, clock),
    )
    return (height, force, counts), channels


def through_c(library, signals, edges, **settings):
    """Return the spans, shape (k, 2), of every kind."""
    made = library.make("screening", rate_hz=RATE, metres_per_count=COUNT_M, **settings)
    spans, written = library.ffi.new("fr_span[]", 100), library.ffi.new("size_t *")
    found = []
    for begin, end in pairwise(edges):
        parts = [library.array(x[begin:end]) for x in signals]
        pointers = [library.at(x) for x in parts]
        assert made.call("push", *pointers, end - begin, spans, 100, written) == 0
        found += [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]
    assert made.call("finish", spans, 100, written) == 0
    found += [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]
    kinds = {
        k: [span for kind, *span in found if kind == k] for k in (GAP, STUCK, OUT_OF_RANGE, SPIKE)
    }
    return {k: np.array(v, np.int64).reshape(-1, 2) for k, v in kinds.items()}


# A gap of 11 is as long as the limit: in the SDK the rounding of its times decides.
FAULTS = st.lists(
    st.tuples(
        st.sampled_from([GAP, STUCK]),
        st.one_of(st.sampled_from([0, LENGTH - 9]), st.integers(0, LENGTH)),
        st.sampled_from([1, 9, 10, 12, 49, 50, 51, 52, 200]),
    ),
    max_size=4,
)


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), faults=FAULTS, cut=st.integers(0, LENGTH))
@example(seed=0, faults=[(STUCK, 700, 51), (STUCK, 900, 52), (GAP, 0, 1)], cut=720)
def test_spans_are_those_of_the_whole_recording(double, seed, faults, cut):
    faults = [(kind, first, length) for kind, first, length in faults if first + length <= LENGTH]
    signals, channels = drive(seed, faults)
    found = through_c(double, signals, [0, cut, LENGTH])
    stuck = find_stuck_height(*channels)
    np.testing.assert_array_equal(found[STUCK], stuck.gone.reshape(-1, 2))
    expected = height_gaps(Recording(channels, Setup()), "main", NOTHING)
    # The SDK says where along the road the samples on either side are; infinite at an end.
    counts = np.concatenate(([-np.inf], signals[2] * COUNT_M, [np.inf]))
    gaps = found[GAP]
    np.testing.assert_allclose(np.stack([counts[gaps[:, 0]], counts[gaps[:, 1] + 1]], 1), expected)


def test_a_sensor_that_repeats_itself_at_a_standstill_is_not_stuck(double):
    (height, force, counts), _ = drive(1, [(STUCK, 100, 900)])
    assert through_c(double, (height, force, counts), [0, LENGTH])[STUCK].tolist() == [[100, 1000]]
    assert not through_c(double, (height, force, 0 * counts), [0, LENGTH])[STUCK].size
    assert not through_c(double, (height, 0 * force, counts), [0, LENGTH])[STUCK].size


def test_spans_without_room_are_refused_and_change_nothing(double):
    signals, _ = drive(1, [(STUCK, 100, 900), (GAP, 1500, 40)])
    made = double.make("screening", rate_hz=RATE, metres_per_count=COUNT_M)
    arrays = [double.array(x) for x in signals]
    pointers = [double.at(x) for x in arrays]
    spans, written = double.ffi.new("fr_span[]", 2), double.ffi.new("size_t *")
    before = made.memory.copy()
    status = made.call("push", *pointers, LENGTH, spans, 1, written)
    assert (double.status[status], written[0]) == ("FR_OUTPUT_FULL", 2)
    assert (made.memory == before).all()
    assert made.call("push", *pointers, LENGTH, spans, 2, written) == 0
    assert [s.kind for s in spans] == [STUCK, GAP]
    assert made.call("finish", spans, 2, written) == 0
    assert double.status[made.call("finish", spans, 2, written)] == "FR_WRONG_ORDER"


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    stays=st.lists(
        st.tuples(
            st.sampled_from([0.25, 0.35]),
            st.integers(1, LENGTH - 250),
            st.sampled_from([1, 4, 5, 6, 49, 50, 200]),
        ),
        max_size=4,
    ),
    cut=st.integers(0, LENGTH),
)
@example(seed=0, stays=[(0.25, 700, 5), (0.35, 900, 30), (0.35, 1500, 200)], cut=720)
def test_a_height_out_of_its_range_is_found_as_in_the_whole_recording(double, seed, stays, cut):
    (height, force, counts), channels = drive(seed, [])
    for end, first, length in stays:
        height[first : first + length] = end
    channels = (Channel.of("height", height, channels[0].clock, "main"), *channels[1:])
    least, greatest = Scan.of(height).extremes
    assert Usual.of(height).beside(0) == 1.0
    ends = {"range_least": least, "range_greatest": greatest}
    found = through_c(double, (height, force, counts), [0, cut, LENGTH], **ends)
    expected = find_stuck_height(*channels).gone.reshape(-1, 2)
    both = np.concatenate([found[OUT_OF_RANGE], found[STUCK]])
    np.testing.assert_array_equal(both[np.argsort(both[:, 0])], expected)


def test_the_ends_of_a_range_are_found_only_after_a_leap(double):
    (height, force, counts), _ = drive(0, [])
    height[700:730], height[1500:1530] = 0.35, height[1499] + 0.002
    ends = {"range_least": 0.2, "range_greatest": 0.3}
    found = through_c(double, (height, force, counts), [0, LENGTH], **ends)
    assert found[OUT_OF_RANGE].tolist() == [[700, 730]]


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    spikes=st.lists(
        st.tuples(
            st.integers(1, LENGTH - 2), st.sampled_from([-0.2, -0.049, 0.049, 0.06, 0.3, np.nan])
        ),
        max_size=6,
    ),
    cut=st.integers(0, LENGTH),
)
@example(seed=0, spikes=[(700, 0.2), (900, -0.06), (901, -0.06), (1200, np.nan)], cut=701)
def test_spikes_of_one_sample_are_those_of_the_whole_channel(double, seed, spikes, cut):
    (height, force, counts), channels = drive(seed, [])
    for at, by in spikes:
        height[at] += by
    found = through_c(double, (height, force, counts), [0, cut, LENGTH], spike=0.05)[SPIKE]
    expected = find_spikes(Channel.of("height", height, channels[0].clock, "main")).gone
    assert UNUSUAL * 0.001 < 0.05
    np.testing.assert_array_equal(found, expected.reshape(-1, 2))


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    stays=st.lists(
        st.tuples(st.integers(0, LENGTH - 200), st.sampled_from([1, 19, 20, 49, 60, 200])),
        max_size=4,
    ),
)
def test_a_stuck_accelerometer_is_that_of_the_whole_channel(double, seed, stays):
    (_, force, counts), channels = drive(seed, [])
    for first, length in stays:
        force[first : first + length] = force[first]
    channel = Channel.of("vertical_specific_force", force, channels[1].clock, "main")
    alone = {"stuck_s": 0.02, "spread_mps2": 0.0}
    found = through_c(double, (force, force, counts), [0, LENGTH], **alone)[STUCK]
    np.testing.assert_array_equal(found, find_stuck_force(channel, channels[2]).gone.reshape(-1, 2))
