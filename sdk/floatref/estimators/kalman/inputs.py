"""From blocks to what the Kalman filter takes: inputs, GNSS readings, standstill, heights."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from operator import itemgetter

import numpy as np

from floatref.estimators.kalman.references import Plan, Stretch
from floatref.estimators.models.kalman_values import HEIGHT as OF_HEIGHT
from floatref.estimators.models.kalman_values import KINDS, Inputs
from floatref.stages.signals import ACCELERATION, HEIGHT, TRAVEL_SPEED
from floatref.values.arrays import BoolArray, FloatArray, IndexArray, frozen
from floatref.values.block import Block, Event, Header
from floatref.values.channels import ChannelId

FORCES = ("longitudinal_specific_force", "lateral_specific_force")
RATES = ("roll_rate", "pitch_rate", "yaw_rate")
IMU = (*FORCES, *RATES)
"""The channels that the Kalman pipelines need beside the nominal ones."""
GNSS = tuple(
    ChannelId(name) for name in ("gnss_height", "gnss_vertical_velocity", "gnss_pitch", "gnss_roll")
)
QUALITY = ChannelId("gnss_quality")
WHOLE = itemgetter(*GNSS, QUALITY)
FIXED = 4.0
"""Quality of a reading whose phase ambiguities are fixed (section 6.4.4)."""
SECONDS, MOVING, STEADY = 4, 5.0, 0.4
"""A constant speed is one beyond 5 m/s that changes by less than 0.4 m/s in four seconds."""
LONGEST_S = 1.0
"""Interval that the first reading is taken to have, and those after a gap."""


def channel_of(header: Header, name: str, track: str) -> ChannelId:
    """Return channel ``name`` of ``track``, or the one that all wheel paths share."""
    own = ChannelId(name, track)
    return own if own in header.channels else ChannelId(name)


@dataclass(frozen=True)
class InputChannels:
    """Where the inputs of one wheel path are found in a block."""

    track: str
    names: tuple[ChannelId, ...]

    @classmethod
    def of(cls, header: Header, track: str) -> "InputChannels":
        """Return the channels of ``track``, in the order of (6.47)."""
        longitudinal, lateral = (channel_of(header, name, track) for name in FORCES)
        rates = (channel_of(header, name, track) for name in RATES)
        return cls(track, (longitudinal, lateral, ChannelId(ACCELERATION, track), *rates))

    def inputs(self, block: Block) -> Inputs:
        """Return the inputs; of Z the vertical acceleration."""
        # Read-only throughout: the kernel is compiled for one kind of array.
        return Inputs(block.first, *(frozen(block[name]) for name in self.names))


@dataclass
class Readings:
    """Usable GNSS readings by sample, each at the sample next to it in time.

    A reading without a height, or without fixed ambiguities, is left out. Sample 0 is at
    ``origin_s``, and ``step`` in s between two of them.
    """

    origin_s: float
    step: float
    held_at: IndexArray = field(default_factory=lambda: np.empty(0, np.int64))
    held: FloatArray = field(default_factory=lambda: np.empty((0, KINDS + 1)))
    before_s: float = -np.inf

    def take(self, events: Sequence[Event], end: int) -> tuple[IndexArray, FloatArray]:
        """Return those before sample ``end``, shapes (m,) and (m, 5)."""
        if events:
            self._hold(events)
        count = int(np.searchsorted(self.held_at, end))
        ready = self.held_at[:count], self.held[:count]
        self.held_at, self.held = self.held_at[count:], self.held[count:]
        return ready

    def _hold(self, events: Sequence[Event]) -> None:
        times, rows = np.array([event.time_s for event in events]), _rows(events)
        usable = (rows[:, KINDS] == FIXED) & ~np.isnan(rows[:, OF_HEIGHT])
        times, rows = times[usable], rows[usable]
        if times.size == 0:
            return
        before = np.concatenate(((self.before_s,), times[:-1]))
        rows[:, KINDS] = np.minimum(times - before, LONGEST_S)
        self.before_s = float(times[-1])
        at = np.maximum(np.rint((times - self.origin_s) / self.step), 0.0).astype(np.int64)
        at, rows = np.concatenate((self.held_at, at)), np.concatenate((self.held, rows))
        # Of two that are next to one sample, or out of order, the first counts.
        latest = np.maximum.accumulate(at)
        first = np.concatenate(((True,), latest[1:] > latest[:-1]))
        self.held_at, self.held = at[first], rows[first]


def _rows(events: Sequence[Event]) -> FloatArray:
    """Return the readings with their quality, shape (m, 5)."""
    try:
        return np.array([WHOLE(event.values) for event in events])
    except KeyError:
        usual = {**dict.fromkeys(GNSS, np.nan), QUALITY: FIXED}
        return np.array([WHOLE({**usual, **event.values}) for event in events])


@dataclass
class Quiet:
    """Where the vehicle has been travelling at a constant speed for four seconds.

    Looked for at every fourth second of the run, from what the encoder went in each of them.
    """

    second: int
    travelled: list[float] = field(default_factory=list)

    def take(self, first: int, distance_m: FloatArray) -> IndexArray:
        """Return the samples of ``distance_m``, whose first is ``first``, that are such places."""
        at = np.arange(-(-first // self.second) * self.second, first + distance_m.size, self.second)
        found = []
        for sample, travelled in zip(at, distance_m[at - first].tolist(), strict=True):
            self.travelled = [*self.travelled[-SECONDS:], travelled]
            if sample % (SECONDS * self.second) == 0 and self._steady():
                found.append(sample)
        return np.array(found, np.int64)

    def _steady(self) -> bool:
        speeds = np.diff(self.travelled)
        return bool(speeds.size == SECONDS and speeds.min() > MOVING and np.ptp(speeds) < STEADY)


def stretch_of(
    block: Block,
    track: str,
    plan: Plan,
    readings: tuple[IndexArray, FloatArray],
    quiet: IndexArray,
) -> Stretch:
    """Return what the references of ``track`` need to know of ``block``."""
    standing: BoolArray = block[ChannelId(TRAVEL_SPEED)] < plan.reflection_speed_mps
    height = ChannelId(HEIGHT, track)
    there = standing
    # Only there is it looked at.
    if standing.any():
        there = standing & ~np.isnan(block[height]) & (block.flags.get(height, 0) == 0)
    return Stretch(block.first, standing, block[height], there, *readings, quiet)
