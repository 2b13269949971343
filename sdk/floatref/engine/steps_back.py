"""An encoder that goes back farther than a vehicle rolls: missing there, and what follows in doubt.

What lies behind the farthest place measures no travel. Where the encoder leaps back to where it was
as it leapt away, as after samples that read 0, the places that follow are right; and so where a
vehicle that hardly moved rolled back. Elsewhere, as after a counter that was set back, they are not
known.
"""

from dataclasses import dataclass, replace

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.values.encoder.direction import MOST, ROLLS_BACK_M, stretches_behind
from floatref.values.recording import Channel, Recording

BEFORE_S = 0.5
"""Time in s before a stretch over which the speed there is averaged."""
STANDS_MPS = 1.0
"""Largest speed in m/s at which a vehicle begins to roll back: it brakes from it within 0.1 s."""
AT_ONCE = 0.5
"""Share of the depth of a stretch that its last step makes up for, where it returns at once."""


@dataclass(frozen=True)
class Forward:
    """A recording whose distance does not go back by more than a vehicle rolls.

    Attributes:
        recording: with missing samples of distance where it did.
        doubts: about the places that follow.
        lines: a warning about each stretch.
    """

    recording: Recording
    doubts: tuple[Doubt, ...] = ()
    lines: tuple[str, ...] = ()


def leave_out_steps_back(recording: Recording) -> Forward:
    """Return ``recording`` without the samples of distance in `stretches_behind`.

    A distance of which too much would be missing is left to be refused.
    """
    changed: dict[ChannelId, Channel] = {}
    doubts: list[Doubt] = []
    lines: list[str] = []
    for channel in (c for c in recording.channels if c.id.name == DISTANCE):
        behind = stretches_behind(channel)
        if not behind.size or np.diff(behind).sum() > MOST * channel.values.size:
            continue
        values = np.array(channel.values)
        for first, end in behind.tolist():
            stretch = _Stretch(channel, first, end)
            values[first:end] = np.nan
            if stretch.is_made_up_for or stretch.is_rolled:
                lines.append(stretch.line + "counted as missing")
            else:
                doubts.append(stretch.doubt)
                lines.append(stretch.doubt.line)
        changed[channel.id] = replace(channel, values=values)
    channels = tuple(changed.get(channel.id, channel) for channel in recording.channels)
    kept = replace(recording, channels=channels) if changed else recording
    return Forward(kept, tuple(doubts), tuple(lines))


@dataclass(frozen=True, eq=False)
class _Stretch:
    """Samples ``first`` to ``end`` - 1 of a distance, behind the farthest before them."""

    channel: Channel
    first: int
    end: int

    @property
    def begin_s(self) -> float:
        """Time in s of its first sample."""
        return float(self.channel.clock.times(1, self.first)[0])

    @property
    def depth_m(self) -> float:
        """How far behind it gets, in m."""
        return self._farthest_m - float(np.nanmin(self._values))

    @property
    def is_made_up_for(self) -> bool:
        """Whether its end leaps back to where the encoder was."""
        if self.end >= self.channel.values.size:
            return False
        known = self._values[~np.isnan(self._values)]
        step = float(self.channel.values[self.end]) - float(known[-1])
        return step > AT_ONCE * (self._farthest_m - float(known[-1])) > AT_ONCE * ROLLS_BACK_M

    @property
    def is_rolled(self) -> bool:
        """Whether it begins at a vehicle that hardly moves, and without a leap."""
        before, values = self._before, self._values
        leap_m = self._farthest_m - float(values[np.argmax(~np.isnan(values))])
        slow_m = STANDS_MPS * before.size / self.channel.mean_rate_hz
        return float(before[-1] - before[0]) <= slow_m and leap_m <= ROLLS_BACK_M

    @property
    def line(self) -> str:
        """Which channel goes back, by how much, and when."""
        return (
            f"channel {self.channel.id}: goes back by {self.depth_m:.4g} m for "
            f"{self.end - self.first} samples from {self.begin_s:.6g} s; "
        )

    @property
    def doubt(self) -> Doubt:
        """That the places are not known from there on."""
        line = self.line + "the place of everything behind is not known; flagged from there on"
        return Doubt((self.channel.id,), line, spans=((self.begin_s, float("inf")),))

    @property
    def _values(self) -> FloatArray:
        return self.channel.values[self.first : self.end]

    @property
    def _before(self) -> FloatArray:
        """Known distances of `BEFORE_S` before it; the last is the farthest."""
        many = max(2, round(BEFORE_S * self.channel.mean_rate_hz))
        found = self.channel.values[max(0, self.first - many) : self.first]
        return found[~np.isnan(found)]

    @property
    def _farthest_m(self) -> float:
        return float(self._before[-1])
