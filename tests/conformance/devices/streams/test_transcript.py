"""A transcript: the first value of a point counts, and every later one is compared with it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_conformance.devices.streams.answers import Path, Points
from floatref_conformance.devices.streams.transcript import Given, differences, lines_of
from floatref_conformance.errors import DeviceError


def points(first, elevation, valid=None, name="left", interval_m=0.25):
    z = np.array(elevation, dtype=float)
    flags = np.isfinite(z) if valid is None else np.array(valid)
    return Points("final", first, interval_m, {name: Path(z, flags)})


def line(*given_points):
    given = [Given(each, float(at)) for at, each in enumerate(given_points)]
    return lines_of(given)["left"]


@given(
    cuts=st.lists(st.integers(1, 9), min_size=1, max_size=6),
    order=st.randoms(use_true_random=False),
)
def test_pieces_in_any_order_make_the_whole_line(cuts, order):
    whole = np.arange(float(sum(cuts)))
    ends = np.cumsum(cuts)
    pieces = [points(int(e - n) - 4, whole[e - n : e]) for n, e in zip(cuts, ends, strict=True)]
    order.shuffle(pieces)
    made = line(*pieces)
    np.testing.assert_array_equal(made.elevation, whole)
    np.testing.assert_allclose(made.distance_m, 0.25 * (np.arange(whole.size) - 4))
    assert not made.changed_m.any()


def test_a_second_value_is_a_change_and_does_not_replace_the_first():
    made = line(points(0, [1.0, 2.0, 3.0]), points(1, [2.5, 3.0]), points(1, [2.25]))
    assert made.elevation.tolist() == [1.0, 2.0, 3.0]
    assert made.changed_m.tolist() == [0.0, 0.5, 0.0]
    assert made.given_s.tolist() == [0.0, 0.0, 0.0]


def test_a_flag_or_a_gap_that_changes_is_an_infinite_change():
    made = line(points(0, [1.0, 2.0, np.nan]), points(0, [1.0, 2.0, 3.0], [False, True, True]))
    assert made.changed_m.tolist() == [np.inf, 0.0, np.inf]


def test_a_gap_between_pieces_was_never_given():
    made = line(points(0, [1.0]), points(3, [np.nan]))
    assert np.isnan(made.given_s).tolist() == [False, True, True, False]


@given(st.lists(st.floats(allow_nan=True, allow_infinity=False, width=32), min_size=1))
def test_what_is_the_same_does_not_differ(values):
    z = np.array(values, dtype=float)
    assert not differences(z, np.isfinite(z), z, np.isfinite(z)).any()


@pytest.mark.parametrize(
    ("other", "named"),
    [
        (points(1, [0.0], interval_m=0.5), "several intervals"),
        (points(1, [0.0], name="right"), "other wheel paths"),
        (points(10**11, [0.0]), "numbers apart"),
    ],
)
def test_what_cannot_be_one_line_is_a_fault(other, named):
    with pytest.raises(DeviceError, match=named):
        lines_of([Given(points(0, [1.0]), 0.0), Given(other, 1.0)])


def test_nothing_given_makes_no_line():
    assert lines_of([]) == {}
