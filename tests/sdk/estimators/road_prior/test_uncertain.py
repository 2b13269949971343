"""What levelling leaves is a part of the 1-σ, and flags with it."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.estimators.road_prior.uncertain import flag_uncertain
from floatref.values.arrays import Flag
from floatref.values.block import Block
from floatref.values.channels import ChannelId

HEIGHT, SIGMA = (ChannelId(n, "left") for n in ("floating_reference_height", "elevation_sigma"))
LEFT_M, BEND_M = st.floats(0.0, 0.02), st.floats(1e-3, 0.1)


@given(own=LEFT_M, levelling=LEFT_M, bend=BEND_M, share=st.floats(0.1, 1.0))
def test_both_are_added_in_quadrature_before_they_are_judged(
    own: float, levelling: float, bend: float, share: float
) -> None:
    names = ("levelled", "levelling_sigma")
    shared = {ChannelId(n): np.full(2, x) for n, x in zip(names, (1.0, levelling), strict=True)}
    block = Block(0, {HEIGHT: np.zeros(2), SIGMA: np.full(2, own), **shared})
    out = flag_uncertain(block, {"left": np.full(2, bend)}, share)
    total = np.hypot(own, levelling)
    np.testing.assert_allclose(out[SIGMA], total)
    assert set(out.values) == {HEIGHT, SIGMA}
    flagged = out.flags.get(HEIGHT, np.zeros(2)) == Flag.UNCERTAIN
    assert (flagged == (total > share * bend)).all()


def test_without_levelling_it_is_the_smoothers_own() -> None:
    block = Block(0, {HEIGHT: np.zeros(3), SIGMA: np.array([0.01, 0.02, 0.03])})
    out = flag_uncertain(block, {"left": np.full(3, 0.05)}, 0.5)
    assert out.flags[HEIGHT].tolist() == [0, 0, Flag.UNCERTAIN]
    assert out.flags[SIGMA].tolist() == [0, 0, Flag.UNCERTAIN]
