"""Screening of an encoder in C finds the stretches that the SDK finds in whole channels."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.screening.damage import encoder_damage
from floatref.screening.damage.encoder_path import EncoderPath
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

RATE, COUNT_M, LENGTH = 1024.0, 2.0**-10, 12_000
# Times in s are exact, and no number of samples is as long as a limit in s.
NO_COUNT = -(2**63)
KINDS = {6: "back", 7: "silent", 8: "leapt", 9: "fast", 10: "lost"}
BEGIN = 600
"""Faults come behind the ways whose median is the SDK's first speed."""
FAULTS = st.lists(
    st.tuples(
        st.sampled_from(["hold", "lose", "miss", "leap", "back", "double", "spike"]),
        st.integers(BEGIN, LENGTH - 10),
        st.sampled_from([1, 2, 19, 20, 21, 30, 60, 250, 2500]),
    ),
    max_size=4,
)


def drive(speed_mps, slower, coarse, faults):
    """Return counts of a drive at a wavy speed, NO_COUNT where missing, with ``faults``."""
    t = np.arange(LENGTH) / RATE
    speed = speed_mps * (1.0 - slower * np.sin(np.pi * np.clip((t - 4.0) / 4.0, 0.0, 1.0)))
    counts = np.floor(np.cumsum(speed) / RATE / COUNT_M / coarse).astype(np.int64) * coarse
    for kind, at, length in faults:
        FAULT[kind](counts, at, min(at + length, LENGTH - 1))
    for kind, at, length in faults:
        if kind == "miss":
            counts[at : at + min(length, 200)] = NO_COUNT
    return counts


def hold(counts, at, behind):
    counts[at:behind] = counts[at]


def lose(counts, at, behind):
    counts[behind:] -= int(counts[behind] - counts[at])
    hold(counts, at, behind)


def double_counts(counts, at, behind):
    step = int(counts[behind] - counts[at])
    counts[at:behind] += counts[at:behind] - counts[at]
    counts[behind:] += step


def shifted(by):
    def shift(counts, at, behind):
        counts[at:behind] += by

    return shift


def leap(counts, at, behind):
    counts[at:] += 400


def spike(counts, at, behind):
    counts[at] += 900


FAULT = {
    "hold": hold,
    "lose": lose,
    "double": double_counts,
    "leap": leap,
    "back": shifted(-40),
    "spike": spike,
    "miss": shifted(0),
}


def in_c(library, counts, edges, usual_m, off_m, ticks=None):
    settings = {"rate_hz": RATE, "metres_per_count": COUNT_M, "usual_m": usual_m, "off_m": off_m}
    made = library.make("encoder_screening", **settings)
    push, signals = ("push", [counts]) if ticks is None else ("push_timed", [counts, ticks])
    room = 2 * LENGTH
    spans, written, found = library.ffi.new("fr_span[]", room), library.ffi.new("size_t *"), []
    for begin, end in pairwise(edges):
        parts = [library.array(x[begin:end]) for x in signals]
        pointers = map(library.at, parts)
        assert made.call(push, *pointers, end - begin, spans, room, written) == 0
        found += [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]
    assert made.call("finish", spans, 4, written) == 0
    return found + [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]


def in_the_sdk(channel):
    """Return the spans of every kind, the usual step, and the largest error of a knot."""
    path = EncoderPath.of(channel)
    seen = []

    def judge(ways, before, off_m, usual_m, kinds):
        seen.append(off_m)
        original(ways, before, off_m, usual_m, kinds)

    original, encoder_damage.judge = encoder_damage.judge, judge
    try:
        damage = encoder_damage.encoder_damage(channel)
    finally:
        encoder_damage.judge = original
    # In C an error of 0 is a setting that is left out.
    return path, damage, max(seen[0], 1e-12)


def mask(spans):
    found = np.zeros(LENGTH + 1, bool)
    for first, behind in spans:
        found[first:behind] = True
    return found


@pytest.mark.slow
@settings(max_examples=80, deadline=None)
@given(
    speed_mps=st.sampled_from([3.0, 8.0, 22.0, 35.0]),
    slower=st.sampled_from([0.0, 0.3, 0.9]),
    coarse=st.sampled_from([1, 4, 30]),
    faults=FAULTS,
    cut=st.integers(0, LENGTH),
)
@example(22.0, 0.0, 1, [("lose", 5000, 250), ("leap", 9000, 1)], 5100)
@example(22.0, 0.0, 4, [("hold", 5000, 60), ("back", 7000, 30), ("double", 9000, 250)], 1)
@example(22.0, 0.0, 1, [("hold", 11_500, 2500), ("spike", 4000, 1), ("miss", 6000, 60)], 0)
def test_stretches_are_those_of_the_whole_channel(double, speed_mps, slower, coarse, faults, cut):
    counts = drive(speed_mps, slower, coarse, faults)
    metres = np.where(counts == NO_COUNT, np.nan, counts * COUNT_M)
    channel = Channel.of("distance", metres, UniformClock.of(RATE))
    path, damage, off_m = in_the_sdk(channel)
    found = in_c(double, counts, [0, cut, LENGTH], path.usual_m, off_m)
    named = [(KINDS[kind], first, behind) for kind, first, behind in found]
    void = [s[1:] for s in named if s[0] in ("leapt", "fast", "lost")]
    gone = [s[1:] for s in named if s[0] in ("back", "silent")]
    np.testing.assert_array_equal(mask(void), mask(damage.void))
    np.testing.assert_array_equal(mask(gone), mask(damage.gone))


@settings(max_examples=40, deadline=None)
@given(
    speed_mps=st.sampled_from([3.0, 22.0]),
    faults=st.lists(
        st.tuples(st.sampled_from(["lose", "leap"]), st.integers(BEGIN, LENGTH - 10), st.just(400)),
        max_size=2,
    ),
)
@example(22.0, [("lose", 5000, 400), ("leap", 9000, 1)])
def test_an_encoder_that_triggers_is_screened_by_its_time_stamps(double, speed_mps, faults):
    counts = drive(speed_mps, 0.3, 4, faults)
    at = np.flatnonzero(np.diff(counts, prepend=-1) > 0)
    channel = Channel.of("distance", counts[at] * COUNT_M, StampedClock.of(at / RATE))
    path, damage, off_m = in_the_sdk(channel)
    found = in_c(double, counts[at], [0, 99, at.size], path.usual_m, off_m, at)
    void = [s[1:] for s in found if KINDS[s[0]] in ("leapt", "fast", "lost")]
    np.testing.assert_array_equal(mask(void), mask(damage.void))


def test_every_kind_is_found_where_it_is(double):
    faults = {
        "back": ("back", 5000, 30),
        "silent": ("hold", 5000, 60),
        "leapt": ("leap", 5000, 1),
        "fast": ("double", 5000, 250),
        "lost": ("lose", 5000, 250),
    }
    for kind, fault in faults.items():
        counts = drive(22.0, 0.0, 1, [fault])
        found = in_c(double, counts, [0, LENGTH], 0.022, 0.0)
        assert {KINDS[number] for number, *_ in found} == {kind}
        assert min(first for _, first, _ in found) <= 5010
        assert max(behind for *_, behind in found) <= 5000 + fault[2] + 30
    assert in_c(double, drive(22.0, 0.9, 1, []), [0, LENGTH], 0.022, 0.0) == []


def test_spans_without_room_are_refused_and_change_nothing(double):
    counts = double.array(drive(22.0, 0.0, 1, [("lose", 5000, 250)]))
    made = double.make("encoder_screening", rate_hz=RATE, metres_per_count=COUNT_M)
    spans, written = double.ffi.new("fr_span[]", 2 * LENGTH), double.ffi.new("size_t *")
    before = made.memory.copy()
    status = made.call("push", double.at(counts), LENGTH, spans, 2 * LENGTH - 1, written)
    assert (double.status[status], written[0]) == ("FR_OUTPUT_FULL", 2 * LENGTH)
    assert (made.memory == before).all()
    assert made.call("push", double.at(counts), LENGTH, spans, 2 * LENGTH, written) == 0
    assert double.status[made.call("finish", spans, 3, written)] == "FR_OUTPUT_FULL"
    assert made.call("finish", spans, 4, written) == 0
    assert double.status[made.call("finish", spans, 4, written)] == "FR_WRONG_ORDER"
