"""A channel at a lower rate: a windowed sinc without delay, for the rate that follows the speed.

Section 4.3 of Zhu ties the rate of the filter to the speed while sensors keep a constant rate.
"""

from dataclasses import dataclass, field
from functools import cache
from math import floor, isfinite

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, frozen


@compiled
def interpolate(
    samples: FloatArray,
    first: int,
    begin: int,
    ratio: float,
    reach: float,
    half: FloatArray,
    found: FloatArray,
) -> None:
    """Write the signal at the places ``(begin + k)·ratio``, counted in input samples.

    ``samples`` begins at the input sample ``first``. ``half`` is the weight at evenly spaced
    distances from 0 to ``reach`` input samples; between them it is linear. Weights are scaled to
    the sum 1. An output that needs values beyond ``samples``, or a missing (NaN) one, is NaN.
    """
    spread = (half.size - 1) / reach
    for k in range(found.size):
        place = (begin + k) * ratio
        low = floor(place - reach) + 1
        high = floor(place + reach)
        if low < first or high >= first + samples.size:
            found[k] = np.nan
            continue
        total, weights = 0.0, 0.0
        for i in range(low, high + 1):
            at = abs(i - place) * spread
            cell = min(int(at), half.size - 2)
            weight = half[cell] + (at - cell) * (half[cell + 1] - half[cell])
            total += weight * samples[i - first]
            weights += weight
        found[k] = total / weights


FLAT, STOPPED = 0.8, 1.0
"""Ends of the pass-band and of the transition, of half the new rate."""
ATTENUATION_DB = 75.0
"""Design attenuation of the window; the stop-band of a sinc under it is at least 60 dB down."""
TABLE = 512
"""Entries of the weight per period of the new rate; between them it is linear."""


@dataclass
class Waiting:
    """Memory of a run of `Resampling` between its parts.

    Attributes:
        samples: the last input samples, which later outputs need.
        first: place of the first of them in the input.
        ready: number of outputs returned.
    """

    samples: FloatArray = field(default_factory=lambda: np.zeros(0))
    first: int = 0
    ready: int = 0


@dataclass(frozen=True)
class Resampling:
    """From one uniform rate to another that is lower or equal; the first samples coincide.

    The pass-band is flat to 0.8 of half the new rate, and what lies above half the new rate is
    at least 60 dB down. There is no delay. Outputs whose window holds a missing sample or reaches
    beyond the ends, `reach_s` on either side, are NaN. With equal rates nothing changes.

    Attributes:
        from_hz: rate of the input.
        to_hz: rate of the output.
    """

    from_hz: float
    to_hz: float

    def __post_init__(self) -> None:
        """Refuse rates that are not positive, and a higher output rate."""
        for rate in (self.from_hz, self.to_hz):
            if not (isfinite(rate) and rate > 0):
                raise InputError(f"resampling: a rate is {rate:g} Hz; give one above zero")
        if self.to_hz > self.from_hz:
            raise InputError(
                f"resampling: {self.to_hz:g} Hz is above the {self.from_hz:g} Hz of the channel; "
                "give a rate that is not higher"
            )

    @property
    def ratio(self) -> float:
        """Input samples per output sample."""
        return self.from_hz / self.to_hz

    @property
    def reach_s(self) -> float:
        """Half the length of the window in s, after Kaiser."""
        width = np.pi * (STOPPED - FLAT)
        return float((ATTENUATION_DB - 7.95) / (2 * 2.285 * width) / self.to_hz)

    def resample(self, samples: ArrayLike) -> FloatArray:
        """Return all of ``samples`` at the new rate: from the first to the last sample within it.

        Raises InputError unless ``samples`` has one dimension.
        """
        memory = self.begin()
        return np.concatenate((self.advance(memory, samples), self.finish(memory)))

    def begin(self) -> Waiting:
        """Return the memory of a run; a copy of it goes on from the same place."""
        return Waiting()

    def advance(self, memory: Waiting, samples: ArrayLike) -> FloatArray:
        """Return the outputs that ``samples``, the next of the input, complete.

        Any split of the input gives the same outputs, bit for bit. Raises InputError unless
        ``samples`` has one dimension.
        """
        memory.samples = np.concatenate((memory.samples, _channel(samples)))
        end, reach = memory.first + memory.samples.size, self._reach
        found = self._until(memory, floor((end - reach) / self.ratio) - 1)
        spent = floor(memory.ready * self.ratio - reach) - memory.first
        if spent > 0:
            memory.samples, memory.first = memory.samples[spent:], memory.first + spent
        return found

    def finish(self, memory: Waiting) -> FloatArray:
        """Return the outputs held back for more input: NaN where that is missing."""
        return self._until(memory, floor((memory.first + memory.samples.size - 1) / self.ratio) + 1)

    @property
    def _reach(self) -> float:
        return self.reach_s * self.from_hz

    def _until(self, memory: Waiting, end: int) -> FloatArray:
        """Return the outputs from the last one returned up to ``end``, and count them."""
        found = np.empty(max(0, end - memory.ready))
        if self.ratio == 1.0:
            begin = memory.ready - memory.first
            found[:] = memory.samples[begin : begin + found.size]
        else:
            interpolate(
                memory.samples, memory.first, memory.ready, self.ratio, self._reach, _half(), found
            )
        memory.ready += found.size
        return found


@cache
def _half() -> FloatArray:
    """Return the weight from the middle of the window to its end: a sinc in a Kaiser window."""
    reach = Resampling(1.0, 1.0).reach_s
    count = int(reach * TABLE) + 2
    window = np.kaiser(2 * count - 1, 0.1102 * (ATTENUATION_DB - 8.7))[count - 1 :]
    return frozen(np.sinc(0.5 * (FLAT + STOPPED) * np.linspace(0.0, reach, count)) * window)


def _channel(samples: ArrayLike) -> FloatArray:
    array = np.asarray(samples, dtype=np.float64)
    if array.ndim != 1:
        raise InputError(
            f"resampling: the samples have the shape {array.shape}; give one channel at a time"
        )
    return array
