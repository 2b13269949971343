"""Travel speed from the encoder, as the suppression algorithms use it."""

import numpy as np

from floatref.errors import InputError
from floatref.stages.marking import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import DISTANCE, TRAVEL_SPEED
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId


class TravelSpeed(Stage):
    """Adds `travel_speed`: the encoder's progress over the preceding ``window_s`` (5.6, 5.7).

    v(t_k) = (d(t_k) - d(t_{k-n})) / (n dt), n the number of samples in the window, at least
    one. Before the first sample the vehicle is taken to stand where it begins, so speed grows
    from zero within the window. A missing distance is bridged by the one before it; the speed
    there is flagged. No point of the profile is changed by this stage itself.
    """

    declared = Declared(shift_invariant=True)

    def __init__(self, window_s: float = 0.05) -> None:
        """Look back over ``window_s`` seconds."""
        super().__init__()
        self.window_s = window_s
        self._samples, self._duration = 1, 1.0

    def open(self, header: Header) -> Header:
        """Ask for the distance in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        header.require(self.name, ChannelId(DISTANCE))
        self._samples = max(1, round(self.window_s * float(header.rate)))
        self._duration = self._samples / float(header.rate)
        self.memory = {"past": None}
        return header.adding(ChannelId(TRAVEL_SPEED))

    def advance(self, block: Block) -> Block:
        """Difference the distances a window apart."""
        speed, distance = ChannelId(TRAVEL_SPEED), ChannelId(DISTANCE)
        flags = flags_of(block, distance)
        marks = {} if flags is None else {speed: flags}
        return block.setting({speed: self._speed(block[distance])}, marks)

    def _speed(self, distance: FloatArray) -> FloatArray:
        if np.isnan(distance.sum()):
            before = self.memory["past"]
            distance = _held(distance, np.nan if before is None else before[-1])
        if self.memory["past"] is None:
            known = distance[~np.isnan(distance)]
            if known.size == 0:
                return np.zeros(distance.size)
            self.memory["past"] = np.full(self._samples, known[0])
            distance = np.where(np.isnan(distance), known[0], distance)
        wide = np.concatenate((self.memory["past"], distance))
        self.memory["past"] = wide[wide.size - self._samples :].copy()
        speed: FloatArray = (distance - wide[: distance.size]) / self._duration
        return speed


def _held(distance: FloatArray, before: float) -> FloatArray:
    wide = np.concatenate(([before], distance))
    last = np.maximum.accumulate(np.where(np.isnan(wide), 0, np.arange(wide.size)))
    return wide[last[1:]]
