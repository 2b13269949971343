"""Saturation and what is usual in C: the spans and values that the SDK finds in whole channels."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.screening.damage.damaged_samples import Usual
from floatref.screening.damage.saturation import STAIR, find_saturation
from floatref.screening.second_sensor.noisier_side import TO_SIGMA, noise_of
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel
from floatref.values.scan import Scan

RATE, LENGTH, SATURATED = 1000.0, 6000, 5
laws = settings(max_examples=40, deadline=None)


def drawn_force(seed, range_mps2, noise, shake, quantum, hold):
    """Return an accelerometer that is cut off ``range_mps2`` from rest."""
    rng = np.random.default_rng(seed)
    t = np.arange(LENGTH) / RATE
    force = 9.81 + noise * rng.normal(size=LENGTH)
    for _ in range(5):
        swing = np.sin(2 * np.pi * rng.uniform(2, 40) * (t - rng.uniform(0, 1)))
        force += shake * rng.uniform(0.2, 1.0) * swing
    force = np.round(force / quantum) * quantum
    force = np.repeat(force[::hold], hold)[:LENGTH]
    force = np.clip(force, 9.81 - range_mps2, 9.81 + range_mps2)
    missing = rng.integers(0, LENGTH, 2)
    force[missing] = np.nan
    return force


def through_c(library, made, signals, edges, push="push"):
    """Return the spans (kind, first, behind) of an object that is pushed in parts."""
    spans, written, found = library.ffi.new("fr_span[]", 9000), library.ffi.new("size_t *"), []
    for begin, end in pairwise(edges):
        parts = [library.array(x[begin:end]) for x in signals]
        pointers = [library.at(x) for x in parts]
        assert made.call(push, *pointers, end - begin, spans, 9000, written) == 0
        found += [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]
    assert made.call("finish", spans, 9000, written) == 0
    return found + [(s.kind, s.first, s.behind) for s in spans[0 : written[0]]]


def usual_in_c(library, values):
    made = library.make("usual")
    with_end = library.array(np.append(values, np.nan))
    assert made.call("push", library.at(with_end), with_end.size) == 0
    found = library.ffi.new("fr_usual_values *")
    assert made.call("value", found) == 0
    return found


@pytest.mark.slow
@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    range_mps2=st.sampled_from([7.4, 10.0, 20.0, 40.0]),
    noise=st.sampled_from([0.0, 0.05, 1.0]),
    shake=st.sampled_from([3.0, 15.0, 30.0]),
    quantum=st.sampled_from([2.0**-12, 0.0078125, 0.125]),
    hold=st.sampled_from([1, 2, 8]),
    cut=st.integers(0, LENGTH),
)
@example(seed=0, range_mps2=10.0, noise=0.05, shake=15.0, quantum=2.0**-12, hold=1, cut=999)
def test_cut_off_swings_are_those_of_the_whole_channel(
    double, seed, range_mps2, noise, shake, quantum, hold, cut
):
    force = drawn_force(seed, range_mps2, noise, shake, quantum, hold)
    channel = Channel.of("vertical_specific_force", force, UniformClock.of(RATE), "main")
    expected = find_saturation(channel).gone
    usual, (least, greatest) = Usual.of(force), Scan.of(force).extremes
    held = min(usual.hold, Usual.of(force, STAIR * usual.quantum).hold)
    ends = {"range_least": least, "range_greatest": greatest}
    made = double.make("saturation", hold=held, quantum=usual.quantum, **ends)
    found = through_c(double, made, [force], [0, cut, LENGTH])
    assert [kind for kind, *_ in found] == [SATURATED] * len(found)
    np.testing.assert_array_equal(np.reshape([s[1:] for s in found], (-1, 2)), expected)


def test_the_example_of_the_law_has_cut_off_swings():
    force = drawn_force(0, 10.0, 0.05, 15.0, 2.0**-12, 1)
    channel = Channel.of("vertical_specific_force", force, UniformClock.of(RATE), "main")
    assert len(find_saturation(channel).gone) > 5


def test_spans_without_room_are_refused_and_change_nothing(double):
    force = double.array(drawn_force(0, 10.0, 0.05, 15.0, 2.0**-12, 1))
    made = double.make("saturation", range_least=-0.19, range_greatest=19.81)
    spans, written = double.ffi.new("fr_span[]", 9000), double.ffi.new("size_t *")
    before = made.memory.copy()
    status = made.call("push", double.at(force), LENGTH, spans, LENGTH // 3, written)
    assert (double.status[status], written[0]) == ("FR_OUTPUT_FULL", LENGTH // 3 + 1)
    assert (made.memory == before).all()
    assert made.call("push", double.at(force), LENGTH, spans, written[0], written) == 0
    before = made.memory.copy()
    assert double.status[made.call("finish", spans, 1, written)] == "FR_OUTPUT_FULL"
    assert (made.memory == before).all()
    assert made.call("finish", spans, written[0], written) == 0
    assert double.status[made.call("finish", spans, 9000, written)] == "FR_WRONG_ORDER"


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    noise=st.sampled_from([0.01, 0.3]),
    quantum=st.sampled_from([2.0**-12, 0.125]),
    hold=st.sampled_from([1, 3, 50]),
)
def test_what_is_usual_is_what_the_sdk_takes_for_usual(double, seed, noise, quantum, hold):
    force = drawn_force(seed, 15.0, noise, 5.0, quantum, hold)
    expected, found = Usual.of(force), usual_in_c(double, force)
    assert (found.least, found.greatest) == Scan.of(force).extremes
    assert (found.quantum, found.hold_of_holds) == (expected.quantum, expected.hold)
    assert found.hold_of_samples == expected.beside(0)
    assert found.samples == np.count_nonzero(np.isfinite(force))


@pytest.mark.parametrize("sigma", [1e-6, 0.003, 0.4, 25.0])
def test_noise_is_that_of_the_sdk_within_half_a_bin(build, sigma):
    values = sigma * np.random.default_rng(3).normal(size=40_000)
    channel = Channel.of("height", values, UniformClock.of(RATE), "main")
    for precision in ("double", "float"):
        found = usual_in_c(build(precision), values).off_neighbours
        assert TO_SIGMA * found == pytest.approx(noise_of(channel), rel=0.06)
        assert found == pytest.approx(0.826 * sigma, rel=0.07)


def test_nothing_is_usual_before_the_first_sample(double):
    made, found = double.make("usual"), double.ffi.new("fr_usual_values *")
    assert double.status[made.call("value", found)] == "FR_WRONG_ORDER"
    nan = double.array([np.nan])
    assert made.call("push", double.at(nan), 1) == 0
    assert double.status[made.call("value", found)] == "FR_WRONG_ORDER"
