"""The laws for vendors pass sound stages and fail each way of breaking them."""

import numpy as np
import pytest

from floatref.stages import integration
from floatref.stages.filters import butterworth
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
    reach = None

    def make(self):
        return butterworth.HighPassB3S2R(CHANNEL, 3.0)


class TestIntegrate(StageLaws):
    reads = ("vertical_acceleration",)
    reach = None

    def make(self):
        return integration.Integrate("vertical_acceleration", "vertical_velocity")


class TestRemoveMean(StageLaws):
    reads = ("vertical_acceleration",)
    tracks = ("main",)
    reach = None

    def make(self):
        return integration.RemoveMean("vertical_acceleration")


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


class OneSided(Gain):
    """Keeps the flags of the left wheel path alone."""

    def advance(self, block):
        out = super().advance(block)
        right = ChannelId(CHANNEL, "right")
        return out.setting({right: out[right]}, {right: np.zeros(len(block), np.uint8)})


class Summing(Gain):
    """Takes what is missing for 0 and flags that sample alone, though all later ones are wrong."""

    declared = Declared(linear=False)

    def advance(self, block):
        values, flags = {}, {}
        for channel in self.channels:
            missing = np.isnan(block[channel])
            before = self.memory.get(str(channel), 0.0)
            sums = np.cumsum([before, *np.where(missing, 0.0, block[channel])])
            self.memory[str(channel)] = sums[-1]
            values[channel] = sums[1:]
            flags[channel] = block.flags.get(channel, 0) | missing.astype(np.uint8)
        return block.setting(values, flags)


class Smoothing(Summing):
    """The mean of the last three samples; a missing one is taken for 0 and flagged alone."""

    def advance(self, block):
        values, flags = {}, {}
        for channel in self.channels:
            missing = np.isnan(block[channel])
            before = self.memory.get(str(channel), np.zeros(2))
            wide = np.concatenate([before, np.where(missing, 0.0, block[channel])])
            self.memory[str(channel)] = wide[-2:]
            values[channel] = (wide[:-2] + wide[1:-1] + wide[2:]) / 3.0
            flags[channel] = block.flags.get(channel, 0) | missing.astype(np.uint8)
        return block.setting(values, flags)


class TestSmoothing(StageLaws):
    reads = (CHANNEL,)
    reach = 2

    def make(self):
        return Smoothing()


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
    OneSided: "test_5_a_flag_comes_out_again",
    Summing: "test_5_a_missing_sample_is_flagged_on_the_way_out",
    Smoothing: "test_5_a_missing_sample_is_flagged_on_the_way_out",
    Endless: "test_6_after_finish_nothing_is_taken",
    Squared: "test_7_it_is_linear_if_it_says_so",
    Offset: "test_7_zero_in_is_zero_out_if_it_says_so",
    ByIndex: "test_7_the_index_does_not_matter_if_it_says_so",
}


@pytest.mark.slow
@pytest.mark.parametrize("stage", BROKEN, ids=lambda stage: stage.__name__)
def test_each_law_fails_a_stage_that_breaks_it(stage):
    class Laws(StageLaws):
        reads = (CHANNEL,)

        def make(self):
            return stage()

    with pytest.raises((AssertionError, ValueError)):
        getattr(Laws(), BROKEN[stage])()


@pytest.mark.slow
@pytest.mark.parametrize(("reach", "stage"), [(1, Smoothing), (20, Summing), (None, Filling)])
def test_a_reach_is_no_longer_than_declared(reach, stage):
    class Laws(StageLaws):
        reads = (CHANNEL,)

        def make(self):
            return stage()

    Laws.reach = reach
    with pytest.raises(AssertionError, match="not flagged"):
        Laws().test_5_a_missing_sample_is_flagged_on_the_way_out()


@pytest.mark.slow
def test_a_flag_is_asked_of_all_that_is_computed_from_it():
    class Beside(Gain):
        """Puts the result beside its source, which alone keeps its flags."""

        def open(self, header):
            super().open(header)
            return header.adding(*(ChannelId("elevation", track) for track in header.tracks))

        def advance(self, block):
            none = np.zeros(len(block), np.uint8)
            made = {ChannelId("elevation", c.track): 2.0 * block[c] for c in self.channels}
            return block.setting(made, dict.fromkeys(made, none))

    class Laws(StageLaws):
        reads = (CHANNEL,)

        def make(self):
            return Beside()

    with pytest.raises(AssertionError, match=r"elevation.*: flag of .*height.* lost"):
        Laws().test_5_a_flag_comes_out_again()


def test_a_subclass_without_make_is_told_what_to_write():
    with pytest.raises(NotImplementedError, match="write make"):
        StageLaws().make()
