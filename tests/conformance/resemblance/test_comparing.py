"""What two vectors have in common: laws that hold for any of them."""

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref_conformance.resemblance.comparing import SHORTEST, GoodRange, compare

NAMES = [f"probe: {n}" for n in range(6)]
VECTORS = st.fixed_dictionaries({name: st.floats(-9, 9) for name in NAMES})
ZERO = GoodRange.of([dict.fromkeys(NAMES, 0.0)])


def length(features, good=ZERO):
    return sum(x * x for x in good.exceed(features).values()) ** 0.5


@settings(max_examples=25, deadline=None)
@given(VECTORS, st.lists(VECTORS, min_size=1, max_size=4))
def test_a_device_is_alike_itself(features, others):
    good = GoodRange.of(others)
    assume(length(features, good) >= 1.01 * SHORTEST)
    assert compare(features, features, good) == pytest.approx(1.0)


@settings(max_examples=25, deadline=None)
@given(VECTORS)
def test_a_device_is_opposite_to_its_mirror(features):
    assume(length(features) >= 1.01 * SHORTEST)
    mirrored = {name: -value for name, value in features.items()}
    assert compare(features, mirrored, ZERO) == pytest.approx(-1.0)


@settings(max_examples=25, deadline=None)
@given(VECTORS, VECTORS, st.lists(VECTORS, min_size=1, max_size=4))
def test_the_order_does_not_matter_and_the_share_is_limited(one, other, others):
    good = GoodRange.of(others)
    alike = compare(one, other, good)
    assert alike == pytest.approx(compare(other, one, good))
    assert -1.0 - 1e-9 <= alike <= 1.0 + 1e-9


@settings(max_examples=25, deadline=None)
@given(VECTORS, st.floats(0.3, 0.99))
def test_less_of_the_same_is_less_alike_and_still_near(features, share):
    beyond = ZERO.exceed(features)
    less = {n: share * x + (features[n] - x if x else 0.0) for n, x in beyond.items()}
    assume(length(less) >= 1.01 * SHORTEST)
    assert compare(features, less, ZERO) == pytest.approx(2 * share / (1 + share**2), rel=1e-6)


@settings(max_examples=25, deadline=None)
@given(st.lists(VECTORS, min_size=1, max_size=4), VECTORS)
def test_a_good_device_resembles_nothing_and_neither_does_one_between_two(devices, flaw):
    good = GoodRange.of(devices)
    middle = {n: (devices[0][n] + devices[-1][n]) / 2 for n in NAMES}
    for each in (*devices, middle):
        assert set(good.exceed(each).values()) == {0.0}
        assert compare(each, flaw, good) == 0.0


@settings(max_examples=25, deadline=None)
@given(VECTORS)
def test_what_good_devices_never_measure_is_not_compared(features):
    unknown = {f"other {name}": value for name, value in features.items()}
    assert compare(unknown, unknown, ZERO) == 0.0
    assert compare(features, dict.fromkeys(features), ZERO) == 0.0
