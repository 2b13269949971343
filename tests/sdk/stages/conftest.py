"""Streams for every stage, and the ways to run one."""

import itertools
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

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
from floatref.stages.protocol import Direction
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

TRACKS = ("left", "right")
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
        if name.startswith(("HighPassB3S", "LowPassB3S"))
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
PER_TRACK = (
    "vertical_specific_force",
    "vertical_acceleration",
    "vertical_velocity",
    "elevation",
    "floating_reference_height",
    "height",
)


class Bench:
    """A stage's stream: its header, its samples (``lost`` ones NaN), and how to push them."""

    def __init__(self, name, seed=0, length=240, lost=()):
        self.make = MAKERS[name]
        self.name = name
        self.values = self._samples(np.random.default_rng(seed), length)
        for channel, samples in self.values.items():
            for begin, count in lost if self.may_be_missing(channel) else ():
                samples[begin : begin + count] = np.nan
        self.header = Header(
            axis=Axis.DISTANCE if name in OVER_DISTANCE else Axis.TIME,
            step=0.01,
            origin=0.0,
            rate=Fraction(100),
            channels=frozenset(self.values),
            tracks=TRACKS,
        )

    def _samples(self, rng, length):
        values = {
            ChannelId(name, track): rng.standard_normal(length)
            for name in PER_TRACK
            for track in TRACKS
        }
        steps = rng.choice([0.0, 0.004, 0.02, 0.07], length)
        values[ChannelId("distance")] = np.cumsum(steps) - steps[0]
        values[ChannelId("time")] = np.cumsum(rng.uniform(0.0, 1.0, length))
        values[ChannelId("travel_speed")] = rng.uniform(0.0, 9.0, length)
        values[ChannelId("high_pass_cutoff")] = rng.uniform(0.5, 20.0, length)
        values[ChannelId("time_step")] = rng.choice([0.0, 0.005, 0.009, 0.03], length)
        values[ChannelId("true_time_step")] = values[ChannelId("time_step")] * 1.5
        return values

    def is_source(self, channel):
        """Tell whether the stage may compute from ``channel``, other than be steered by it."""
        return channel.track is not None or channel.name == SOURCES.get(self.name)

    def is_target(self, channel):
        """Tell whether ``channel`` is, or may be, what the stage computes."""
        return channel.track is not None or channel.name in TARGETS.get(self.name, ())

    def may_be_missing(self, channel):
        """Tell whether samples of ``channel`` may be missing."""
        return self.is_source(channel) or channel.name in MAY_BE_MISSING

    @property
    def backward(self):
        return self.make().direction is Direction.BACKWARD

    def blocks(self, cuts=(), values=None, flags=None, first=0):
        values = self.values if values is None else values
        edges = [0, *sorted(set(cuts)), next(iter(values.values())).size]
        return [
            Block(
                first + a,
                {c: x[a:b] for c, x in values.items()},
                flags={c: f[a:b] for c, f in (flags or {}).items()},
            )
            for a, b in itertools.pairwise(edges)
        ]

    def begin(self, blocks):
        stage = self.make()
        self.out_header = stage.start(self.header)
        for block in blocks if stage.surveys else ():
            stage.survey(block)
        return stage

    def run(self, blocks):
        """Return what comes out, joined, in the order of the index."""
        stage = self.begin(blocks)
        out = [stage.push(b) for b in (reversed(blocks) if self.backward else blocks)]
        return joined([*out, *stage.finish()])


def joined(blocks):
    blocks = sorted((b for b in blocks if len(b)), key=lambda b: b.first)
    channels = blocks[0].values
    flagged = {c for b in blocks for c in b.flags}
    return replace(
        blocks[0],
        values={c: np.concatenate([b[c] for b in blocks]) for c in channels},
        flags={
            c: np.concatenate([b.flags.get(c, np.zeros(len(b), np.uint8)) for b in blocks])
            for c in flagged
        },
    )


def same(one, two):
    assert one.first == two.first
    assert one.values.keys() == two.values.keys()
    for channel, values in one.values.items():
        np.testing.assert_array_equal(values, two[channel], err_msg=str(channel))
    blank = np.zeros(len(one), np.uint8)
    for channel in one.values:
        marks = (b.flags.get(channel, blank) for b in (one, two))
        np.testing.assert_array_equal(*marks, err_msg=f"flags of {channel}")


@pytest.fixture
def bench():
    return Bench


@pytest.fixture
def identical():
    return same


@pytest.fixture
def join():
    return joined
