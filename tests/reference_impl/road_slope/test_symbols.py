"""Which nodes are in one piece."""

from collections.abc import Callable

import pytest

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.symbols import Stretch, has_both_sides, is_cut

C = Constants(interval_s=0.1)


@pytest.mark.parametrize("cut", [1, 2, 7, 18, 19])
def test_the_nodes_beside_a_cut_and_at_the_ends_have_one_side(
    stopping: Callable[..., Stretch], cut: int
) -> None:
    stretch = stopping(C, K=20, cut=cut)
    assert [k for k in range(1, 20) if is_cut(stretch, k)] == [cut]
    one_side = {k for k in range(20) if not has_both_sides(stretch, k)}
    assert one_side == {0, cut - 1, cut, 19}


def test_rounding_of_times_cuts_nothing(stopping: Callable[..., Stretch]) -> None:
    stretch = stopping(C, K=20)
    nearly = stretch.readings._replace(pause=stretch.readings.pause * (1 + 1e-9))
    assert has_both_sides(stretch._replace(readings=nearly), 10)
