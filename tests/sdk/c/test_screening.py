"""Screening in C finds the gaps and the stuck stretches that the SDK finds in whole recordings."""

from itertools import pairwise

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.intake.height_gaps import height_gaps
from floatref.screening.damage.stuck_sensors import find_stuck_height
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup

RATE, COUNT_M, LENGTH = 1000.0, 2.0**-10, 3000
COUNTS = 10
"""A sample: half a metre is 51.2 samples."""
GAP, STUCK = 1, 2
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


def through_c(library, signals, edges):
    """Return the spans, shape (k, 2), of both kinds."""
    made = library.make("screening", rate_hz=RATE, metres_per_count=COUNT_M)
    spans, written = library.ffi.new("fr_span[]", 100), library.ffi.new("size_t *")
    found = []
    for begin, end in pairwise(edges):
        parts = [library.array(x[begin:end]) for x in signals]
        pointers = [library.at(x) for x in parts]
        assert made.call("push", *pointers, end - begin, spans, 100, written) == 0
        found += [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]
    assert made.call("finish", spans, 100, written) == 0
    found += [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]
    kinds = {k: [span for kind, *span in found if kind == k] for k in (GAP, STUCK)}
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
