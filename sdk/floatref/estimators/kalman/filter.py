"""The Kalman filter in place of both integrations, without the smoother."""

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.estimators.kalman.inputs import (
    GNSS,
    IMU,
    InputChannels,
    Quiet,
    Readings,
    channel_of,
    stretch_of,
)
from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.normalized import NormalizedInnovations
from floatref.estimators.kalman.references import Plan
from floatref.estimators.kalman.track import FLOORS, TrackFilter
from floatref.estimators.smoothing.nodes import Filtered, Nodes
from floatref.stages.marks import flags_of, long_gaps
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION, DISTANCE, HEIGHT, REFERENCE_HEIGHT, TRAVEL_SPEED
from floatref.values.arrays import FloatArray, frozen
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.innovations import Innovations
from floatref.values.recording import ORIGIN

UNITS = ("m", "m/s", "rad", "rad")


def describe_left_out(memories: Sequence[np.record], origin_s: float, step: float) -> Iterator[str]:
    """Yield a line for each channel of GNSS with readings that were left out.

    ``memories`` are those of the filters of all wheel paths, which read the same; sample 0 was at
    ``origin_s``, and ``step`` in s lies between two.
    """
    for kind, (channel, floor, unit) in enumerate(zip(GNSS, FLOORS, UNITS, strict=True)):
        found = [each for each in memories if each.rejected[kind]]
        if not found:
            continue
        at = min(int(each.rejected_at[kind]) for each in found)
        count = max(int(each.rejected[kind]) for each in found)
        readings = "1 reading" if count == 1 else f"{count} readings"
        yield (
            f"channel {channel}: {readings} left out, more than {floor:.3g} {unit} and ten times "
            f"the expected 1-σ off, the first at {origin_s + at * step:.6g} s; check the receiver "
            "there, and the profile around it"
        )


class KalmanStage(Stage):
    """What filter and smoother have in common: channels, references, forward pass.

    Adds `floating_reference_height` of every track; the vertical acceleration and all channels of
    the inertial unit are dropped.
    """

    declared = Declared(linear=False, zero_in_zero_out=False, shift_invariant=False)
    has_innovations: ClassVar[bool] = True

    def __init__(self, plan: Plan, noise: Noise, wavelength_m: float = 105.91) -> None:
        """Observe as in ``plan``, with ``noise``; the result is cut off at ``wavelength_m``."""
        super().__init__()
        self.plan, self.noise, self.wavelength_m = plan, noise, wavelength_m
        self._header: Header | None = None
        self._channels: tuple[InputChannels, ...] = ()
        self._made: frozenset[ChannelId] = frozenset()

    def open(self, header: Header) -> Header:
        """Ask for the sensors of every track and the travel speed, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        header.require(self.name, ChannelId(TRAVEL_SPEED), ChannelId(DISTANCE))
        for track in header.tracks:
            own = [ChannelId(name, track) for name in (ACCELERATION, HEIGHT)]
            shared = [channel_of(header, name, track) for name in IMU]
            header.require(self.name, *own, *shared)
        self._header = header
        self._channels = tuple(InputChannels.of(header, track) for track in header.tracks)
        readings = Readings(header.origin, header.step)
        quiet = Quiet(round(1.0 / header.step))
        self.memory = {"readings": readings, "quiet": quiet, "filters": {}}
        out = header.replacing(ACCELERATION, REFERENCE_HEIGHT).without(*IMU)
        self._made = out.channels
        return out

    def forward(self, block: Block) -> dict[str, Filtered]:
        """Filter every track."""
        readings = self.memory["readings"].take(block.events, block.first + len(block))
        quiet = self.memory["quiet"].take(block.first, block[ChannelId(DISTANCE)])
        found = {}
        for channels in self._channels:
            track, names = channels.track, channels.names
            stretch = stretch_of(block, track, self.plan, readings, quiet)
            own, lost = self._filter(track, block), long_gaps(block, ChannelId(ACCELERATION, track))
            passed = own.advance(channels.inputs(block), stretch, lost)
            complete = () if passed.missing else names
            flags = flags_of(block, *names, ChannelId(HEIGHT, track), complete=complete)
            found[track] = Filtered(passed.height, passed.nodes, flags)
        return found

    def warnings(self) -> tuple[str, ...]:
        """Warn of the kinds of GNSS readings that were left out, how often, and from when on."""
        filters: dict[str, TrackFilter] = self.memory["filters"]
        memories = [each.state.memory for each in filters.values()]
        assert self._header is not None
        return tuple(describe_left_out(memories, self._header.origin, self._header.step))

    def list_innovations(self) -> Mapping[str, Mapping[str, Innovations]]:
        """Return those of all readings and constants, by `normalized.NAMES`."""
        filters: dict[str, TrackFilter] = self.memory["filters"]
        return {
            track: each.innovations.finish(each.state.memory.rejected)
            for track, each in filters.items()
            if each.innovations is not None
        }

    def ending(self) -> dict[str, tuple[Nodes, FloatArray | None]]:
        """Return of every track the node at the last sample, and lambda behind it."""
        filters: dict[str, TrackFilter] = self.memory["filters"]
        return {track: (f.end(), f.beyond()) for track, f in filters.items()}

    def _filter(self, track: str, block: Block) -> TrackFilter:
        filters: dict[str, TrackFilter] = self.memory["filters"]
        if track not in filters:
            assert self._header is not None
            setup, step = self._header.setup, self._header.step
            point = setup.tracks[track].reference_point_m if track in setup.tracks else ORIGIN
            x, y, z = np.subtract(setup.gnss_antenna_offset_m, point).tolist()
            start = np.nan_to_num(block[ChannelId(HEIGHT, track)][:1])
            filters[track] = TrackFilter.of(self.plan, self.noise, step, (x, y, z), float(start[0]))
            if self.keeps_innovations:
                kept = NormalizedInnovations(self._header.origin, step, self.plan.attitude)
                filters[track].innovations = kept
        return filters[track]

    def empty(self, first: int) -> Block:
        """Return an output without samples at sample ``first``."""
        return Block(first, dict.fromkeys(self._made, frozen(())))


class KalmanFilter(KalmanStage):
    """The filter alone (section 6.6.1): its height steps at every reading."""

    def advance(self, block: Block) -> Block:
        """Filter every track."""
        if len(block) == 0:
            return self.empty(block.first)
        values, flags = {}, {}
        for track, found in self.forward(block).items():
            values[ChannelId(REFERENCE_HEIGHT, track)] = found.height
            if found.flags is not None:
                flags[ChannelId(REFERENCE_HEIGHT, track)] = found.flags
        return block.setting(values, flags).without(ACCELERATION, *IMU)
