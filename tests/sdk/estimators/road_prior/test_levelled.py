"""Where a stretch is levelled the smoother takes brakes for no tilt, and elsewhere it does."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

RATE = 100
HEIGHT, SIGMA = (ChannelId(n, "left") for n in ("floating_reference_height", "elevation_sigma"))
SHARE, LEFT = ChannelId("levelled"), ChannelId("levelling_sigma")
few = settings(deadline=None, max_examples=4)
TILTS: list[dict[str, float]] = [{"tilt_sigma": 1e-4}, {"tilt_expected": 0.01}, {"walk_along": 0.0}]


@dataclass(frozen=True, eq=False)
class Levelled:
    """A drive with the share to which it is levelled, and the 1-σ in m that this leaves."""

    drive: Any
    share: float
    left_m: float = 0.0

    @property
    def header(self) -> Header:
        """That of the drive with both channels."""
        found: Header = self.drive.header.adding(SHARE, LEFT)
        return found

    def blocks(self, cuts: Any = ()) -> list[Block]:
        """Return the drive with both channels, cut before each of the samples ``cuts``."""
        more = {SHARE: self.share, LEFT: self.left_m}
        return [
            block.setting({c: np.full(len(block), x) for c, x in more.items()}, {})
            for block in self.drive.blocks(cuts)
        ]


@few
@given(seed=st.integers(0, 2**32 - 1))
def test_with_nothing_levelled_all_is_as_without(drive, through, seed):
    drawn = drive(seed, 15.0, RATE, (5.0, 8.0))
    stages = RoadPriorSmoother(), RoadPriorSmoother()
    plain, other = (
        through(stage, each)
        for stage, each in zip(stages, (drawn, Levelled(drawn, 0.0)), strict=True)
    )
    np.testing.assert_array_equal(other[HEIGHT], plain[HEIGHT])
    np.testing.assert_array_equal(other[SIGMA], plain[SIGMA])
    assert stages[0].list_learned() == stages[1].list_learned() != {}


@pytest.mark.parametrize("changed", TILTS, ids=lambda changed: next(iter(changed)))
def test_where_it_is_levelled_brakes_are_no_tilt(drive, through, changed):
    """How much a body tilts by acceleration, and what that does to the bias, is of no effect."""
    drawn = drive(3, 15.0, RATE, (5.0, 8.0))
    for share in (0.0, 1.0):
        heights = []
        for constants in (RoadPrior(), RoadPrior(**changed)):
            heights.append(through(RoadPriorSmoother(constants), Levelled(drawn, share))[HEIGHT])
        moved = np.abs(heights[0] - heights[1]).max()
        assert moved < 1e-9 if share else moved > 1e-6


def test_the_lean_of_a_levelled_wheel_path_is_still_sought(drive, through):
    """It is what one wheel path has from the mean of all, with a third of the 1-σ."""
    drawn = drive(3, 15.0, RATE, (5.0, 8.0))
    heights = [
        through(RoadPriorSmoother(RoadPrior(lean_sigma_rad=each)), Levelled(drawn, 1.0))[HEIGHT]
        for each in (0.03, 1e-6)
    ]
    assert np.abs(heights[0] - heights[1]).max() > 1e-5
    third = through(RoadPriorSmoother(RoadPrior(lean_sigma_rad=0.01, **NO_TILT)), drawn)
    levelled = through(RoadPriorSmoother(RoadPrior(lean_sigma_rad=0.03)), Levelled(drawn, 1.0))
    np.testing.assert_allclose(levelled[HEIGHT], third[HEIGHT], atol=1e-7)


NO_TILT = {"tilt_sigma": 1e-9, "walk_along": 0.0}


def test_what_levelling_leaves_is_in_the_sigma_and_its_channels_end(drive, through):
    drawn = drive(5, 15.0, RATE, (5.0, 8.0))
    stage = RoadPriorSmoother()
    sure, unsure = (through(RoadPriorSmoother(), Levelled(drawn, 1.0, m)) for m in (0.0, 0.02))
    np.testing.assert_allclose(unsure[SIGMA], np.hypot(sure[SIGMA], 0.02))
    np.testing.assert_array_equal(unsure[HEIGHT], sure[HEIGHT])
    assert not {SHARE, LEFT} & stage.start(Levelled(drawn, 1.0).header).channels
    assert not {SHARE, LEFT} & set(unsure.values)


def test_lean_and_tilt_are_left_to_what_has_levelled(drive, through):
    stage = RoadPriorSmoother()
    through(stage, Levelled(drive(5, 15.0, RATE, (5.0, 8.0)), 0.5))
    assert stage.list_learned() == {}
