"""The laws for vendors pass sound stages and fail each way of breaking them."""

import numpy as np
import pytest

from floatref.stages import butterworth, integration, mean_removal
from floatref.stages.protocol import Declared, Stage
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws

CHANNEL = "height"


class Gain(Stage):
    """Twice the height; sound, and to be broken."""

    def open(self, header):
        self.channels = [ChannelId(CHANNEL, track) for track in header.tracks]
        self.memory = {"seen": 0}
        return header

    def advance(self, block):
        out = {c: self.of(block[c], block) for c in self.channels}
        self.memory["seen"] += len(block)
        return block.setting(out)

    def of(self, values, block):
        return 2.0 * values


class TestGain(StageLaws):
    reads = (CHANNEL,)

    def make(self):
        return Gain()


class TestHighPass(StageLaws):
    reads = (CHANNEL,)

    def make(self):
        return butterworth.HighPassB3S2R(CHANNEL, 3.0)


class TestIntegrate(StageLaws):
    reads = ("vertical_acceleration",)

    def make(self):
        return integration.Integrate("vertical_acceleration", "vertical_velocity")


class TestRemoveMean(StageLaws):
    reads = ("vertical_acceleration",)
    tracks = ("main",)

    def make(self):
        return mean_removal.RemoveMean("vertical_acceleration")


class BlockMean(Gain):
    def of(self, values, block):
        return values - values.mean() if len(block) else values


class LaterBlocks(Gain):
    def of(self, values, block):
        return values + float(self.memory["seen"] > 0)


class InPlace(Gain):
    def of(self, values, block):
        values.flags.writeable = True
        values *= 2.0
        return values.copy()


class Forgetful(Gain):
    total = 0.0

    def of(self, values, block):
        out = self.total + np.cumsum(values)
        self.total = out[-1] if out.size else self.total
        return out


class Filling(Gain):
    def of(self, values, block):
        return np.nan_to_num(values)


class Unflagged(Gain):
    def advance(self, block):
        out = super().advance(block)
        for marks in out.flags.values():
            marks[:] = 0
        return out


class Endless(Gain):
    def push(self, block):
        return self.advance(block)


class Squared(Gain):
    def of(self, values, block):
        return values**2


class Offset(Gain):
    declared = Declared(linear=False)

    def of(self, values, block):
        return values + 1.0


class ByIndex(Gain):
    declared = Declared(linear=False, zero_in_zero_out=False)

    def of(self, values, block):
        return values + (block.first + np.arange(len(block))) % 7


class Swallowing(Gain):
    def advance(self, block):
        whole = super().advance(block)
        keep = max(len(block) - 1, 0)
        values = {c: v[:keep] for c, v in whole.values.items()}
        return type(block)(block.first, values)


BROKEN = {
    BlockMean: "test_1_any_split_gives_the_same_output",
    LaterBlocks: "test_1_any_split_gives_the_same_output",
    Swallowing: "test_2_indices_are_contiguous_and_totals_equal",
    InPlace: "test_3_the_input_is_left_as_it_was",
    Forgetful: "test_4_saving_and_restoring_changes_nothing",
    Filling: "test_5_a_missing_sample_is_flagged_on_the_way_out",
    Unflagged: "test_5_a_flag_comes_out_again",
    Endless: "test_6_after_finish_nothing_is_taken",
    Squared: "test_7_it_is_linear_if_it_says_so",
    Offset: "test_7_zero_in_is_zero_out_if_it_says_so",
    ByIndex: "test_7_the_index_does_not_matter_if_it_says_so",
}


@pytest.mark.parametrize("stage", BROKEN, ids=lambda stage: stage.__name__)
def test_each_law_fails_a_stage_that_breaks_it(stage):
    class Laws(StageLaws):
        reads = (CHANNEL,)

        def make(self):
            return stage()

    with pytest.raises((AssertionError, ValueError)):
        getattr(Laws(), BROKEN[stage])()


def test_a_subclass_without_make_is_told_what_to_write():
    with pytest.raises(NotImplementedError, match="write make"):
        StageLaws().make()
