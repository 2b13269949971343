"""What two vectors have in common: laws that hold for any of them."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from floatref_conformance.resemblance.comparing import MARGIN, compare, exceed, spread_of

NAMES = st.sampled_from([f"probe: {n}" for n in range(12)])
VECTORS = st.dictionaries(NAMES, st.one_of(st.floats(-9, 9)), min_size=1)
SPREADS = st.dictionaries(NAMES, st.floats(0, 3))


def length(features, spread):
    return sum(x * x for x in exceed(features, spread).values())


@given(VECTORS, SPREADS)
def test_a_device_is_alike_itself_and_opposite_to_its_mirror(features, spread):
    assume(length(features, spread) >= 1.01)
    mirrored = {name: -value for name, value in features.items()}
    assert compare(features, features, spread) == pytest.approx(1.0)
    assert compare(features, mirrored, spread) == pytest.approx(-1.0)


@given(VECTORS, VECTORS, SPREADS)
def test_the_order_does_not_matter_and_the_share_is_limited(one, other, spread):
    alike = compare(one, other, spread)
    assert alike == pytest.approx(compare(other, one, spread))
    assert -1.0 - 1e-9 <= alike <= 1.0 + 1e-9


@given(VECTORS, st.floats(0.25, 0.99))
def test_less_of_the_same_is_less_alike_than_the_same(features, share):
    assume(length(features, {}) * share**2 >= 1.01)
    less = {name: share * value for name, value in features.items()}
    assert 0.0 < compare(features, less, {}) == pytest.approx(2 * share / (1 + share**2))


@given(st.lists(VECTORS, min_size=1), VECTORS)
def test_a_good_device_resembles_nothing(good, flaw):
    spread = spread_of(good)
    assert all(value == 0.0 for each in good for value in exceed(each, spread).values())
    assert all(compare(each, flaw, spread) == 0.0 for each in good)
    assert MARGIN >= 1.0


@given(VECTORS)
def test_nothing_shared_is_nothing_alike(features):
    other = {f"other {name}": value for name, value in features.items()}
    missing = dict.fromkeys(features)
    assert compare(features, other, {}) == compare(features, missing, {}) == 0.0
