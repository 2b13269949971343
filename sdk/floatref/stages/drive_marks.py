"""Marks for slow travel and hard braking, from the encoder."""

import numpy as np

from floatref.errors import InputError
from floatref.stages.marking import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ACCELERATION, DISTANCE
from floatref.values.arrays import Flag, FlagArray, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

WINDOW_S = 0.25
"""Two such windows are compared: short enough to mark a brake where it begins, long enough that
coarse encoder counts do not flicker."""
SLOW_MPS = 16 / 3.6
"""16 km/h, below which every suppression algorithm gives the profile up (section 5.1)."""
BRAKING_G = 0.16
"""Braking up to here rarely raised the roughness (section 3.3.1.3)."""


class MarkDrive(Stage):
    """Flags `vertical_acceleration` of every track where the vehicle crawls, stands or brakes.

    `Flag.SLOW` where the mean speed over the last half second is below ``slow_mps``: there a
    basic algorithm squeezes drift into one spot, a cut-off in time (sections 5.5 and 5.7) or PI
    control (section 5.6) removes the road's longer waves, and timer distortion with reflection
    (section 5.10) removes all of it. `Flag.BRAKING` where the speed fell by more than
    ``braking_g`` allows between the two halves of it: there the accelerometer's axis is tilted
    and sees the deceleration (1.4). A mark comes up to half a second late. Within the first half
    second of a run nothing is marked, since there is nothing to compare with; filter run-in
    covers it. Values stay as they are.
    """

    declared = Declared(shift_invariant=True)

    def __init__(self, slow_mps: float = SLOW_MPS, braking_g: float = BRAKING_G) -> None:
        """Mark travel below ``slow_mps`` and braking beyond ``braking_g``."""
        super().__init__()
        self.slow_mps, self.braking_g = slow_mps, braking_g
        self._window, self._slow, self._braking = 1, 0.0, 0.0

    def open(self, header: Header) -> Header:
        """Ask for the distance in time, and for the acceleration of every track."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        header.require(self.name, ChannelId(DISTANCE))
        header.require(self.name, *(ChannelId(ACCELERATION, t) for t in header.tracks))
        self._tracks = header.tracks
        self._window = max(1, round(WINDOW_S * float(header.rate)))
        window_s = self._window / float(header.rate)
        self._slow = self.slow_mps * 2 * window_s
        self._braking = self.braking_g * STANDARD_GRAVITY * window_s**2
        self.memory = {"past": np.full(2 * self._window, np.nan)}
        return header

    def advance(self, block: Block) -> Block:
        """Add the marks to the flags of the acceleration."""
        marks = self._marks(block[ChannelId(DISTANCE)])
        if not marks.any():
            return block
        flags = {}
        for track in self._tracks:
            channel = ChannelId(ACCELERATION, track)
            own = flags_of(block, channel)
            flags[channel] = marks if own is None else own | marks
        return block.setting({}, flags)

    def _marks(self, distance: FloatArray) -> FlagArray:
        from floatref.kernels import motion

        wide = np.concatenate((self.memory["past"], distance))
        self.memory["past"] = wide[distance.size :].copy()
        flags = np.empty(distance.size, np.uint8)
        kinds = int(Flag.SLOW), int(Flag.BRAKING)
        motion.mark_drive(wide, self._window, self._slow, self._braking, kinds, flags)
        return flags
