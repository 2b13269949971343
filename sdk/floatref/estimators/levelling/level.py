"""The vertical acceleration by the measured attitude, in place of one less 1 g."""

from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.estimators.kalman.inputs import FORCES, IMU, RATES, channel_of
from floatref.estimators.levelling.attitude import Attitude
from floatref.estimators.smoothing.backlog import ALL
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION, DISTANCE
from floatref.values.arrays import Flag, FlagArray, FloatArray, frozen
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

BLENDED_S = 3.0
Turned = list[tuple[Block, dict[str, FloatArray]]]


class Level(Stage):
    """Levels the accelerometers: `vertical_acceleration` in place of `vertical_specific_force`.

    The result is (2.20) with the attitude by the rates at once and that by gravity, with
    the encoder, over ``blended_s`` seconds to either side; so blocks wait for some five times as
    long, plus four seconds. All channels of the inertial unit are dropped.
    """

    declared: ClassVar[Declared] = Declared(linear=False, zero_in_zero_out=False, delay=ALL)

    def __init__(self, blended_s: float = BLENDED_S) -> None:
        """Use the rates over shorter, gravity over longer times than ``blended_s`` seconds."""
        super().__init__()
        self.blended_s = blended_s
        self._channels: dict[str, tuple[ChannelId, ...]] = {}
        self._made: frozenset[ChannelId] = frozenset()

    def open(self, header: Header) -> Header:
        """Ask for the inertial unit of every track and the encoder, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        for track in header.tracks:
            forces = [channel_of(header, name, track) for name in FORCES]
            rates = [channel_of(header, name, track) for name in RATES]
            own = *forces, ChannelId(SPECIFIC_FORCE, track), *rates
            header.require(self.name, *own, ChannelId(DISTANCE))
            self._channels[track] = own
        attitudes = {t: Attitude.of(header.step, self.blended_s) for t in header.tracks}
        self.memory = {"attitudes": attitudes, "begin": None, "seen": [], "turned": []}
        out = header.replacing(SPECIFIC_FORCE, ACCELERATION).without(*IMU)
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
                return self._level()
        waiting = [each for each, _ in self.memory["turned"]] + self.memory["seen"] + [block]
        return Block(waiting[0].first, dict.fromkeys(self._made, frozen(())))

    def close(self) -> tuple[Block, ...]:
        """Return all that remains."""
        for attitude in self._attitudes.values():
            attitude.see_end()
        self._turn()
        for attitude in self._attitudes.values():
            attitude.turn_end()
        return tuple(self._level() for _ in self.memory["turned"][:])

    @property
    def _attitudes(self) -> dict[str, Attitude]:
        found: dict[str, Attitude] = self.memory["attitudes"]
        return found

    def _valid_rows(self, track: str, block: Block) -> FloatArray:
        """Return forces, rates and distance of ``block``, NaN where they are flagged."""
        x, y, _, *rates = self._channels[track]
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
                rates = np.stack([block[name] for name in self._channels[track][3:]])
                found[track] = attitude.turn(rates, at)
            self.memory["turned"].append((block, found))

    def _level(self) -> Block:
        waiting: Turned = self.memory["turned"]
        block, turned = waiting.pop(0)
        at, values, flags = block.first - self.memory["begin"], {}, {}
        for track, attitude in self._attitudes.items():
            names, target = self._channels[track], ChannelId(ACCELERATION, track)
            force = np.stack([block[name] for name in names[:3]])
            values[target], unknown = attitude.level(force, turned[track], at)
            marks = flags_of(block, *names)
            if unknown.any():
                lost = np.where(unknown, np.uint8(Flag.MISSING | Flag.DRIFT), np.uint8(0))
                marks = lost if marks is None else marks | lost
            if marks is not None:
                flags[target] = marks
        return block.setting(values, flags).without(SPECIFIC_FORCE, *IMU)


def _trusted_samples(block: Block, channel: ChannelId) -> FloatArray:
    flags: FlagArray | None = block.flags.get(channel)
    return block[channel] if flags is None else np.where(flags == 0, block[channel], np.nan)
