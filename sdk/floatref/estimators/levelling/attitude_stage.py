"""What stages by the measured attitude have in common: blocks wait until it is known."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.estimators.kalman.inputs import FORCES, RATES, channel_of
from floatref.estimators.levelling.attitude import Attitude
from floatref.estimators.smoothing.backlog import ALL
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import FlagArray, FloatArray, frozen
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

BLENDED_S = 3.0
Turned = list[tuple[Block, dict[str, FloatArray]]]
Own = tuple[Mapping[ChannelId, FloatArray], Mapping[ChannelId, FlagArray]]
"""New samples and flags of a wheel path."""
Lever = tuple[float, float]
"""A laser ahead of and to the left of its accelerometer, in m."""


def raise_by(lever: Lever, angles: FloatArray) -> FloatArray:
    """Return by how much a laser on a ``lever`` is higher than its accelerometer, in m.

    That is -x sin θ + y cos θ sin φ of (6.23), for pitch and roll in rad, shape (2, n).
    """
    pitch, roll = angles
    raised = np.sin(pitch) * -lever[0]
    if lever[1]:
        raised += lever[1] * np.cos(pitch) * np.sin(roll)
    return np.asarray(raised)


class AttitudeStage(Stage):
    """Computes something of every wheel path from the attitude that an inertial unit measures.

    That is the one by the rates at once and the one by gravity, with the encoder, over
    ``blended_s`` seconds to either side; so blocks wait for some five times as long, plus four
    seconds.
    """

    declared: ClassVar[Declared] = Declared(linear=False, zero_in_zero_out=False, delay=ALL)

    source: ClassVar[str]
    """Channel of every wheel path that is computed from."""
    made: ClassVar[str]
    """Channel of every wheel path that is computed."""
    dropped: ClassVar[tuple[str, ...]] = ()
    """Channels that end here."""

    def __init__(self, blended_s: float = BLENDED_S) -> None:
        """Use the rates over shorter, gravity over longer times than ``blended_s`` seconds."""
        super().__init__()
        self.blended_s = blended_s
        self.channels: dict[str, tuple[ChannelId, ...]] = {}
        """Of every wheel path: longitudinal and lateral specific force, what it computes from, and
        the rates."""
        self._made: frozenset[ChannelId] = frozenset()

    @abstractmethod
    def compute(
        self, track: str, block: Block, attitude: Attitude, turned: FloatArray, at: int
    ) -> Own:
        """Return new samples and flags of ``track``; the block begins at sample ``at`` of the run.

        ``turned``, shape (2, n), are the integrated rates of pitch and roll.
        """

    def tracks_of(self, header: Header) -> Sequence[str]:
        """Return the wheel paths whose inertial unit is read, and for which `compute` is called."""
        return header.tracks

    def open(self, header: Header) -> Header:
        """Ask for the inertial unit of these tracks and the encoder, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        for track in self.tracks_of(header):
            forces = [channel_of(header, name, track) for name in FORCES]
            rates = [channel_of(header, name, track) for name in RATES]
            own = *forces, ChannelId(self.source, track), *rates
            header.require(self.name, *own, ChannelId(DISTANCE))
            self.channels[track] = own
        attitudes = {t: Attitude.of(header.step, self.blended_s) for t in self.channels}
        self.memory = {"attitudes": attitudes, "begin": None, "seen": [], "turned": []}
        out = header.replacing(self.source, self.made).without(*self.dropped)
        self._made = out.channels
        return out

    def advance(self, block: Block) -> Block:
        """Take a block in, and return one whose attitude is known."""
        if len(block):
            if self.memory["begin"] is None:
                self.memory["begin"] = block.first
            for track, attitude in self._attitudes.items():
                attitude.see(self._valid_rows(track, block))
            self.memory["seen"].append(block)
            self._turn()
            if self._ready(self.memory["turned"], "levels_before"):
                return self._apply()
        waiting = [each for each, _ in self.memory["turned"]] + self.memory["seen"] + [block]
        return Block(waiting[0].first, dict.fromkeys(self._made, frozen(())))

    def close(self) -> tuple[Block, ...]:
        """Return all that remains."""
        for attitude in self._attitudes.values():
            attitude.see_end()
        self._turn()
        for attitude in self._attitudes.values():
            attitude.turn_end()
        return tuple(self._apply() for _ in self.memory["turned"][:])

    @property
    def _attitudes(self) -> dict[str, Attitude]:
        found: dict[str, Attitude] = self.memory["attitudes"]
        return found

    def _valid_rows(self, track: str, block: Block) -> FloatArray:
        """Return forces, rates and distance of ``block``, NaN where they are flagged."""
        x, y, _, *rates = self.channels[track]
        return np.stack(
            [_trusted_samples(block, name) for name in (x, y, *rates, ChannelId(DISTANCE))]
        )

    def _ready(self, waiting: Turned, bound: str) -> bool:
        if not waiting:
            return False
        end = waiting[0][0].first + len(waiting[0][0]) - self.memory["begin"]
        return all(getattr(each, bound) >= end for each in self._attitudes.values())

    def _turn(self) -> None:
        """Integrate the rates of the blocks whose slow angles are known."""
        seen: list[Block] = self.memory["seen"]
        while seen and self._ready([(seen[0], {})], "turns_before"):
            block, found = seen.pop(0), {}
            at = block.first - self.memory["begin"]
            for track, attitude in self._attitudes.items():
                rates = np.stack([block[name] for name in self.channels[track][3:]])
                found[track] = attitude.turn(rates, at)
            self.memory["turned"].append((block, found))

    def _apply(self) -> Block:
        waiting: Turned = self.memory["turned"]
        block, turned = waiting.pop(0)
        at = block.first - self.memory["begin"]
        values: dict[ChannelId, FloatArray] = {}
        flags: dict[ChannelId, FlagArray] = {}
        for track, attitude in self._attitudes.items():
            new, marks = self.compute(track, block, attitude, turned[track], at)
            values.update(new)
            flags.update(marks)
        return block.setting(values, flags).without(*self.dropped)


def _trusted_samples(block: Block, channel: ChannelId) -> FloatArray:
    flags: FlagArray | None = block.flags.get(channel)
    return block[channel] if flags is None else np.where(flags == 0, block[channel], np.nan)
