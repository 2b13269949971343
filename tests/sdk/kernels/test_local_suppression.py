"""The controller of local suppression acts below its limit alone, and leaves no step."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import local_suppression as kernel
from floatref.kernels.memories import CONTROLLER
from floatref.values.arrays import new_record

LIMIT, K_P, K_I_DT = 4.0, 0.001, 0.834e-3
SEEDS = st.integers(0, 2**32 - 1)
FEW = settings(deadline=None, max_examples=15)


def held(d, speed):
    y = np.empty(d.size)
    kernel.hold_at_zero(d, speed, y, new_record(CONTROLLER), LIMIT, K_P, K_I_DT)
    return y


def wandering(seed, size=600):
    rng = np.random.default_rng(seed)
    return 1e-3 * rng.standard_normal(size).cumsum(), rng.choice([1.0, 9.0], size // 60).repeat(60)


@FEW
@given(seed=SEEDS, limit=st.floats(4.0, 9.0))
def test_nothing_happens_at_the_limit_and_above(seed, limit):
    d, _ = wandering(seed)
    np.testing.assert_array_equal(held(d, np.full(600, limit)), d)


@FEW
@given(seed=SEEDS, at=st.integers(1, 598), of_speed=st.booleans())
def test_a_missing_value_is_the_one_before_it(seed, at, of_speed):
    d, speed = wandering(seed)
    whole_d, whole_speed = d.copy(), speed.copy()
    missing, whole = (speed, whole_speed) if of_speed else (d, whole_d)
    whole[at] = whole[at - 1]
    missing[at] = np.nan
    np.testing.assert_array_equal(held(d, speed), held(whole_d, whole_speed))
