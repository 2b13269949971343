"""The road that was left out of the accelerations is added to every reference height."""

from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.estimators.road_slope import AddRoad
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws

ROAD = ChannelId("expected_road")
LEFT, RIGHT = (ChannelId("floating_reference_height", track) for track in ("left", "right"))
METRES = st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=20)


@given(road=METRES, raised=st.floats(-10.0, 10.0))
def test_every_wheel_path_is_raised_by_the_road(road: list[float], raised: float) -> None:
    header = Header(Axis.TIME, 0.01, 0.0, None, frozenset((ROAD, LEFT, RIGHT)), ("left", "right"))
    found, stage = np.array(road), AddRoad()
    out = stage.start(header)
    block = stage.push(Block(0, {ROAD: found, LEFT: found - raised, RIGHT: 0.0 * found}))
    np.testing.assert_allclose(block[LEFT], 2.0 * found - raised)
    np.testing.assert_array_equal(block[RIGHT], found)
    assert out.channels == set(block.values) == {LEFT, RIGHT}


def test_it_asks_for_the_road() -> None:
    header = Header(Axis.TIME, 0.01, 0.0, None, frozenset((LEFT,)), ("left",))
    with pytest.raises(InputError, match="expected_road"):
        AddRoad().start(header)


class TestAddRoad(StageLaws):
    """One sample makes one sample."""

    reads = ("floating_reference_height",)
    shared = ("expected_road",)
    ranges: ClassVar = {"expected_road": (-1.0, 1.0)}

    def make(self) -> AddRoad:
        return AddRoad()
