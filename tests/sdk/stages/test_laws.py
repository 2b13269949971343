"""The laws of the stage protocol, for every stage that is registered: a vendor's, and stricter."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from floatref.engine.plugins import plugins
from floatref.errors import InputError, StageError
from floatref.stages import (
    conditioning,
    integration,
    marks,
    resampling,
    speed,
    suppression,
    timer_distortion,
)
from floatref.stages.filters import butterworth, matched_high_pass, schedule, varying
from floatref.values.arrays import Flag
from floatref.values.block import Axis
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws
from floatref_conformance.testing.stage_laws import CUTS, SEEDS, assert_same, laws, resume
from floatref_conformance.testing.streams import LENGTH, Stream, marks_of

BY_STAGE_LAWS = {"Advance", "CompareTravel", "Denoise", "EstimateRoad", "JoinTyres", "KalmanFilter"}
BY_STAGE_LAWS |= {"Abeam", "AddRoad", "HeightByAttitude", "HeightByModel"}
BY_STAGE_LAWS |= {"LevelByRoad", "LevelTriggered"}
BY_STAGE_LAWS |= {"KalmanSmoother", "Level", "RestoreContact", "RoadPriorSmoother", "Seams"}
BY_STAGE_LAWS |= {"ShiftAlong", "ToRate", "ToTime"}
"""Stages that are held to the laws in tests of their own."""
STAGES = sorted(set(plugins().stages()) - BY_STAGE_LAWS)
STEERED = ("VaryingHighPass", "StateHighPass", "MatchedHighPass", "SuppressLocally")
LASTING = ("High", "Low", "Vary", "State", "Match", "Integrate", "RemoveMean", "Suppress")
"""Stages with a memory that never ends, by the beginning of their names."""
LOST = st.lists(st.tuples(st.integers(0, LENGTH - 1), st.integers(1, 60)), max_size=3)
MAKERS = {
    "Combine": integration.Combine,
    "DistortTimer": lambda: timer_distortion.DistortTimer(slow_speed=1.0),
    "Drop": lambda: conditioning.Drop("time_step", "elevation"),
    "FromFirst": lambda: conditioning.FromFirst("height"),
    "IntegrateReflecting": timer_distortion.IntegrateReflecting,
    "MarkDrive": lambda: marks.MarkDrive(1e-6, 1e-6),
    "MatchedHighPass": matched_high_pass.MatchedHighPass,
    "RemoveGravity": conditioning.RemoveGravity,
    "ScheduleCutOff": schedule.ScheduleCutOff,
    "ScheduleWaveNumber": schedule.ScheduleWaveNumber,
    "SuppressLocally": suppression.SuppressLocally,
    "TravelSpeed": lambda: speed.TravelSpeed(0.1),
    "Integrate": lambda: integration.Integrate("vertical_acceleration", "vertical_velocity"),
    "RemoveMean": lambda: integration.RemoveMean("vertical_acceleration"),
    "TimeStep": resampling.TimeStep,
    "ToDistance": lambda: resampling.ToDistance(0.02, 0.0, keep_time=True),
    **{
        name: lambda name=name: getattr(butterworth, name)("elevation", 3.0)
        for name in dir(butterworth)
        if name.startswith(("HighPassB3S", "LowPassB3"))
    },
    **{
        name: lambda name=name: getattr(varying, name)("elevation")
        for name in dir(varying)
        if name.startswith(("VaryingHighPassB3", "StateHighPassB3"))
    },
}
OVER_DISTANCE = {"DistortTimer", "IntegrateReflecting", "ScheduleWaveNumber", "TimeStep"}
SOURCES = {
    "DistortTimer": "time_step",
    "ScheduleCutOff": "travel_speed",
    "ScheduleWaveNumber": "travel_speed",
    "TravelSpeed": "distance",
}
"""The shared channel that a stage computes from; others compute from those of the tracks."""
TARGETS = {
    "DistortTimer": {"time_step", "true_time_step"},
    "ScheduleCutOff": {"high_pass_cutoff"},
    "ScheduleWaveNumber": {"high_pass_cutoff"},
    "TravelSpeed": {"travel_speed"},
}
MAY_BE_MISSING = {"travel_speed", "high_pass_cutoff"}
"""Shared channels that a stage bridges."""
READS = {
    "Combine": ("floating_reference_height", "height"),
    "FromFirst": ("height",),
    "Integrate": ("vertical_acceleration",),
    "IntegrateReflecting": ("height", "vertical_velocity"),
    "MarkDrive": ("vertical_acceleration",),
    "MatchedHighPass": ("height", "vertical_acceleration"),
    "RemoveGravity": ("vertical_specific_force",),
    "RemoveMean": ("vertical_acceleration",),
    "SuppressLocally": ("vertical_velocity",),
}
"""Channels of a wheel path that a stage reads beside the elevation."""


def samples(seed, read):
    """Return samples of the channels ``read`` of every wheel path, and of all others."""
    rng = np.random.default_rng(seed)
    tracks = StageLaws.tracks
    values = {ChannelId(n, t): rng.standard_normal(LENGTH) for n in read for t in tracks}
    steps = rng.choice([0.0, 0.004, 0.02, 0.07], LENGTH)
    values[ChannelId("distance")] = np.cumsum(steps) - steps[0]
    values[ChannelId("time")] = np.cumsum(rng.uniform(0.0, 1.0, LENGTH))
    values[ChannelId("travel_speed")] = rng.uniform(0.0, 9.0, LENGTH)
    values[ChannelId("high_pass_cutoff")] = rng.uniform(0.5, 20.0, LENGTH)
    values[ChannelId("time_step")] = rng.choice([0.0, 0.005, 0.009, 0.03], LENGTH)
    values[ChannelId("true_time_step")] = values[ChannelId("time_step")] * 1.5
    return values


class OwnStage(StageLaws):
    """A vendor's laws, and what holds of our own stages beyond them."""

    name = ""

    def make(self):
        return MAKERS[self.name]()

    def stream(self, seed=0, lost=()):
        """Return the stream of a vendor's laws with stretches ``lost`` of what may be missing."""
        values = samples(seed, self.reads)
        for channel in filter(self.may_be_missing, values if lost else ()):
            for begin, count in lost:
                values[channel][begin : begin + count] = np.nan
        return Stream(self.make, values, self.tracks, self.axis)

    def is_source(self, channel):
        """Tell whether the stage may compute from ``channel``, other than be steered by it."""
        return channel.track is not None or channel.name == SOURCES.get(self.name)

    def is_target(self, channel):
        """Tell whether ``channel`` is, or may be, what the stage computes."""
        return channel.track is not None or channel.name in TARGETS.get(self.name, ())

    def may_be_missing(self, channel):
        return self.is_source(channel) or channel.name in MAY_BE_MISSING

    @laws
    @given(seed=SEEDS, cuts=CUTS, lost=LOST)
    @example(seed=0, cuts=[1, 90], lost=[(0, 100)])
    @example(seed=0, cuts=[150], lost=[(140, 100)])
    def test_1_any_split_of_lost_stretches_gives_the_same_output(self, seed, cuts, lost):
        stream = self.stream(seed, lost)
        assert_same(stream.run(), stream.run(cuts))

    def test_3_what_comes_out_are_the_channels_of_the_header(self):
        stream = self.stream()
        for values in stream.samples.values():
            values.flags.writeable = False
        assert stream.run().values.keys() == self.make().start(stream.header).channels

    @laws
    @given(seed=SEEDS, at=st.integers(1, 5), lost=LOST)
    def test_4_a_state_saved_in_a_lost_stretch_is_the_state(self, seed, at, lost):
        stream = self.stream(seed, lost)
        assert_same(resume(stream, [40, 80, 120, 160, 200], at), stream.run())

    @laws
    @given(seed=SEEDS, at=st.integers(1, LENGTH - 2), flag=st.booleans())
    def test_5_a_missing_or_flagged_sample_is_flagged_there_alone(self, seed, at, flag):
        stream = self.stream(seed)
        used = [c for c in stream.samples if self.may_be_missing(c)]
        marks = np.where(np.arange(LENGTH) == at, np.uint8(Flag.DRIFT), np.uint8(0))
        if flag:
            stream = replace(stream, flags=dict.fromkeys(used, marks))
        else:
            stream = stream.change(lambda c, x: np.where(marks, np.nan, x) if c in used else x)
        out = stream.run()
        if self.keeps_index:
            hit = affected = np.arange(LENGTH) == at
        else:
            hit, affected = points_hit(out[ChannelId("time")], at / 100.0, flag)
        for channel in filter(self.is_target, out.values):
            flagged, missing = marks_of(out, channel) != 0, np.isnan(out[channel])
            assert (flagged | missing)[hit].all()
            assert not (flagged | missing)[~affected].any()

    def test_5_a_missing_speed_or_cut_off_flags_what_it_steers(self):
        if not self.name.startswith(STEERED):
            return
        stream = self.stream()
        steering = "travel_speed" if self.name == "SuppressLocally" else "high_pass_cutoff"
        stream.samples[ChannelId(steering)][100] = np.nan
        out = stream.run()
        flagged = {c for c, flags in out.flags.items() if c.track and flags.any()}
        assert {channel.track for channel in flagged} == set(stream.tracks)
        for channel in flagged:
            assert set(np.flatnonzero(out.flags[channel])) == {100}
            assert not np.array_equal(out[channel], stream.samples.get(channel))

    def test_6_after_finish_it_neither_finishes_nor_starts(self):
        stream = self.stream()
        stage = stream.begin(stream.blocks())
        stage.finish()
        with pytest.raises(StageError, match="finish after finish"):
            stage.finish()
        with pytest.raises(StageError, match="started twice"):
            stage.start(stream.header)

    @laws
    @given(seed=SEEDS, other=SEEDS)
    def test_7_it_says_whether_it_is_linear(self, seed, other):
        one, two = self.stream(seed), self.stream(other)
        fixed = one.change(lambda c, x: two.samples[c] if self.is_source(c) else x)
        summed = one.change(lambda c, x: x + 2.0 * two.samples[c] if self.is_source(c) else x)
        first, second, out = one.run(), fixed.run(), summed.run()
        close = [
            np.allclose(out[c], first[c] + 2.0 * second[c], atol=1e-9, rtol=1e-9)
            for c in filter(self.is_target, out.values)
        ]
        assert all(close) == self.make().declared.linear

    def test_7_it_says_whether_zero_in_is_zero_out(self):
        zeros = self.stream().change(lambda c, x: 0.0 * x if self.is_source(c) else x)
        out = zeros.run()
        silent = not any(out[c].any() for c in filter(self.is_target, out.values))
        assert silent == self.make().declared.zero_in_zero_out

    def test_blocks_out_of_order_are_refused(self):
        stream = self.stream()
        blocks = stream.blocks([100, 200])
        stage = stream.begin(blocks)
        stage.push(blocks[1])
        with pytest.raises(StageError, match="expected"):
            stage.push(blocks[1])

    def test_a_stream_without_the_channel_is_refused_by_name(self):
        bare = replace(self.stream().header, channels=frozenset())
        with pytest.raises(InputError, match=f"stage {self.name} needs channel"):
            self.make().start(bare)


def points_hit(times, when, drift):
    """Points that must be flagged (a drift has to reach the later one), and that may be."""
    read = np.abs(times - when) < 0.01
    after = np.arange(times.size) == np.searchsorted(times, when - 0.01 + 1e-9)
    if drift:
        return after, read | after
    return times == when, read


def of(name):
    """Return the laws of stage ``name``, as a vendor writes them down."""
    settings = {
        "name": name,
        "axis": Axis.DISTANCE if name in OVER_DISTANCE else Axis.TIME,
        "keeps_index": name != "ToDistance",
        "reads": ("elevation", *READS.get(name, ())),
        "reach": None if name.startswith(LASTING) else 0,
    }
    return type(f"Test{name}", (OwnStage,), settings)


globals().update({f"Test{name}": of(name) for name in STAGES})
