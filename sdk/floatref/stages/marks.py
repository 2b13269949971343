"""Marks for slow travel and for braking near a standstill, from the encoder."""

from collections.abc import Collection

import numpy as np

from floatref.errors import InputError
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION, DISTANCE
from floatref.values.arrays import BoolArray, Flag, FlagArray, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId


def flags_of(
    block: Block, *channels: ChannelId, complete: Collection[ChannelId] = ()
) -> FlagArray | None:
    """Return the flags of all ``channels`` together, NaN as `Flag.MISSING`, or None.

    Those that are known to be ``complete`` are not searched for NaN.
    """
    flags: FlagArray | None = None
    for channel in channels:
        missing = None if channel in complete else _missing(block, channel)
        for more in (block.flags.get(channel), missing):
            if more is not None:
                flags = more if flags is None else flags | more
    return flags


def long_gaps(block: Block, channel: ChannelId) -> BoolArray | None:
    """Return which samples of ``channel`` lie in a gap too long to be bridged, or None."""
    flags = block.flags.get(channel)
    lost = None if flags is None else (flags & np.uint8(Flag.DRIFT)) != 0
    return lost if lost is not None and lost.any() else None


def _missing(block: Block, channel: ChannelId) -> FlagArray | None:
    values = block[channel]
    # A sum is NaN if and only if a sample is; infinities never enter a recording.
    if not np.isnan(values.sum()):
        return None
    return np.where(np.isnan(values), np.uint8(Flag.MISSING), np.uint8(0))


WINDOW_S = 0.25
"""Two such windows are compared: short enough to mark a brake where it begins, long enough that
coarse encoder counts do not flicker."""
SLOW_MPS = 4.4704
"""10 mph, printed as 16 km/h, below which every suppression algorithm loses the profile (5.1)."""
STOPPING_TIME_S = 5.0
"""0.16 g, up to which braking rarely raised the roughness (section 3.3.1.3), takes so long to a
standstill from 28 km/h; the brakes behind that figure were released at 24 and 32 km/h."""


class MarkDrive(Stage):
    """Flags an acceleration of every track where the vehicle crawls, stands or brakes.

    `Flag.SLOW` where the mean speed over the last half second is below ``slow_mps``: there a basic
    algorithm squeezes drift into one spot, a cut-off in time (sections 5.5 and 5.7) or PI control
    (section 5.6) removes the road's longer waves, and timer distortion with reflection (section
    5.10) removes all of it. Else `Flag.BRAKING` where the vehicle would stop within
    ``stopping_time_s`` at the deceleration between its two halves. The accelerometer's axis tilts
    in proportion to the deceleration a and sees that part of it, an error as a² (1.5); at the speed
    v the profile is bent falsely by as much over v². So it is the time v/a to a standstill that
    counts, and the same brake causes a larger error at a lower speed (section 2.3.2).

    A mark comes up to half a second late. Within the first half second of a run nothing is
    marked, since there is nothing to compare with; filter run-in covers it. Values stay as they
    are.
    """

    declared = Declared(shift_invariant=True)

    def __init__(
        self,
        slow_mps: float = SLOW_MPS,
        stopping_time_s: float = STOPPING_TIME_S,
        channel: str = ACCELERATION,
    ) -> None:
        """Mark travel below ``slow_mps``, else braking within ``stopping_time_s`` of a standstill.

        The marks are flags of ``channel``.
        """
        super().__init__()
        self.slow_mps, self.stopping_time_s = slow_mps, stopping_time_s
        self.channel = channel
        self._window, self._slow, self._windows = 1, 0.0, 0.0

    def open(self, header: Header) -> Header:
        """Ask for the distance in time, and for the acceleration of every track."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        header.require(self.name, ChannelId(DISTANCE))
        header.require(self.name, *(ChannelId(self.channel, t) for t in header.tracks))
        self._tracks = header.tracks
        self._window = max(1, round(WINDOW_S * float(header.rate)))
        window_s = self._window / float(header.rate)
        self._slow = self.slow_mps * 2 * window_s
        self._windows = 2 * self.stopping_time_s / window_s
        self.memory = {"past": np.full(2 * self._window, np.nan)}
        return header

    def advance(self, block: Block) -> Block:
        """Add the marks to the flags of the acceleration."""
        marks = self._marks(block[ChannelId(DISTANCE)])
        if not marks.any():
            return block
        flags = {}
        for track in self._tracks:
            channel = ChannelId(self.channel, track)
            own = flags_of(block, channel)
            flags[channel] = marks if own is None else own | marks
        return block.setting({}, flags)

    def _marks(self, distance: FloatArray) -> FlagArray:
        from floatref.kernels import motion

        wide = np.concatenate((self.memory["past"], distance))
        self.memory["past"] = wide[distance.size :].copy()
        flags = np.empty(distance.size, np.uint8)
        kinds = int(Flag.SLOW), int(Flag.BRAKING)
        motion.mark_drive(wide, self._window, self._slow, self._windows, kinds, flags)
        return flags
