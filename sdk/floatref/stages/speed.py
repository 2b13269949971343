"""Travel speed from the encoder, as the suppression algorithms use it."""

import numpy as np

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import DISTANCE, TRAVEL_SPEED
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

WINDOW_S = 0.05
"""The encoder's progress over this time is the travel speed (5.6)."""


def progress_speed(distance: FloatArray, samples: int, duration_s: float) -> FloatArray:
    """Return the progress of ``distance``, shape (N,), over ``samples`` of it, as a speed in m/s.

    That is (d_k - d_{k-n}) / T for every k from n on, shape (N - n,), n samples lasting T =
    ``duration_s``.
    """
    return np.asarray((distance[samples:] - distance[: distance.size - samples]) / duration_s)


class TravelSpeed(Stage):
    """Adds `travel_speed`: the encoder's progress over the preceding ``window_s`` (5.6, 5.7).

    v(t_k) = (d(t_k) - d(t_{k-n})) / (n dt), n the number of samples in the window, at least one.
    Before the first sample the vehicle is taken to be stationary, so speed grows from zero within
    the window. While the window has a missing distance the last speed is repeated, and where the
    distance is missing the speed is flagged. No point of the profile is changed by this stage
    itself.
    """

    declared = Declared(shift_invariant=True)

    def __init__(self, window_s: float = WINDOW_S) -> None:
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
        self.memory = {"past": None, "speed": 0.0}
        return header.adding(ChannelId(TRAVEL_SPEED))

    def advance(self, block: Block) -> Block:
        """Difference the distances a window apart."""
        speed, distance = ChannelId(TRAVEL_SPEED), ChannelId(DISTANCE)
        flags = flags_of(block, distance)
        marks = {} if flags is None else {speed: flags}
        return block.setting({speed: self._speed(block[distance])}, marks)

    def _speed(self, distance: FloatArray) -> FloatArray:
        if self.memory["past"] is None:
            known = distance[~np.isnan(distance)]
            if known.size == 0:
                return np.zeros(distance.size)
            self.memory["past"] = np.full(self._samples, known[0])
            distance = distance.copy()
            distance[: int(np.argmax(~np.isnan(distance)))] = known[0]
        wide = np.concatenate((self.memory["past"], distance))
        self.memory["past"] = wide[wide.size - self._samples :].copy()
        speed = progress_speed(wide, self._samples, self._duration)
        if np.isnan(wide.sum()):
            speed = self._keep_last(speed, np.isnan(wide))
        self.memory["speed"] = float(speed[-1]) if speed.size else self.memory["speed"]
        return speed

    def _keep_last(self, speed: FloatArray, missing: BoolArray) -> FloatArray:
        """Return ``speed`` with the last one before wherever the window has a ``missing``."""
        count = np.cumsum(np.append(0, missing))
        unknown = count[self._samples + 1 :] - count[: speed.size] > 0
        last = np.maximum.accumulate(np.where(unknown, 0, np.arange(1, speed.size + 1)))
        return np.append(self.memory["speed"], speed)[last]
