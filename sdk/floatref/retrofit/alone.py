"""Stages without a stream: plain arrays in, one plain array out."""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.stages.protocol import Stage
from floatref.stages.signals import DISTANCE, TIME_STEP, TRAVEL_SPEED, TRUE_TIME_STEP
from floatref.values.arrays import Flag, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.plain import above_zero, numbers

TRACK = "main"
SHARED = frozenset({DISTANCE, TIME_STEP, TRAVEL_SPEED, TRUE_TIME_STEP})


class Alone:
    """A chain of stages for one wheel path.

    Attributes:
        bridged: number of missing (NaN) samples that were bridged so far.
    """

    def __init__(
        self, axis: Header, inputs: Sequence[str], output: str, stages: Sequence[Stage]
    ) -> None:
        """Start ``stages``, given the signals named ``inputs``, to compute ``output`` from them."""
        self._inputs = tuple(_channel(name) for name in inputs)
        self._output, self._stages = _channel(output), tuple(stages)
        header = axis.adding(*self._inputs)
        for stage in self._stages:
            header = stage.start(header)
        self._next = 0
        self.bridged = 0

    def __call__(self, *signals: FloatArray) -> FloatArray:
        """Return the output for the next samples, shape (N,), of all inputs."""
        block = Block(self._next, dict(zip(self._inputs, signals, strict=True)))
        self._next += len(block)
        for stage in self._stages:
            block = stage.push(block)
        flags = block.flags.get(self._output)
        if flags is not None:
            self.bridged += int(np.count_nonzero(flags & Flag.MISSING))
        result = block[self._output]
        # Stages return read-only arrays of their own; here the array belongs to the caller.
        result.flags.writeable = True
        return result


def in_time(rate_hz: float | Fraction) -> Header:
    """Return the time axis of ``rate_hz``, no signals yet; InputError for an unlikely rate."""
    rate = UniformClock(_rational(rate_hz)).rate
    return Header(Axis.TIME, float(1 / rate), 0.0, rate, frozenset(), (TRACK,))


def over_distance(interval_m: float) -> Header:
    """Return the distance axis of ``interval_m``, no signals yet; InputError unless above zero."""
    interval_m = above_zero("interval_m", interval_m)
    return Header(Axis.DISTANCE, interval_m, 0.0, Fraction(1), frozenset(), (TRACK,))


def chunks(call: str, **signals: ArrayLike) -> tuple[FloatArray, ...]:
    """Return ``signals`` as read-only contiguous float64 arrays of one common shape (N,).

    All have one layout, since filters are compiled again for every other one. Raises InputError in
    the name of ``call`` for anything else, for an infinite sample, and for signals of different
    length.
    """
    arrays = {name: _chunk(f"{call}: {name}", values) for name, values in signals.items()}
    lengths = {array.size for array in arrays.values()}
    if len(lengths) > 1:
        found = ", ".join(f"{array.size} of {name}" for name, array in arrays.items())
        raise InputError(f"{call}: {found}; give as many samples of each")
    return tuple(arrays.values())


def _chunk(name: str, values: ArrayLike) -> FloatArray:
    array = numbers(name, values)
    if array.ndim != 1:
        raise InputError(
            f"{name} has shape {array.shape}; give one wheel path, shape (N,), which is (1,) for "
            "a single sample"
        )
    return array


def _rational(rate_hz: float | Fraction) -> Fraction:
    if isinstance(rate_hz, Fraction):
        return rate_hz
    # Single precision rounds the rate, and a time axis must not drift.
    if isinstance(rate_hz, bool) or not isinstance(rate_hz, int | float | np.integer):
        kind = type(rate_hz).__name__
        raise InputError(f"rate_hz is {rate_hz!r}, {kind}; give int, float or Fraction, in Hz")
    if isinstance(rate_hz, float):
        return UniformClock.of(rate_hz).rate
    return Fraction(int(rate_hz))


def _channel(name: str) -> ChannelId:
    return ChannelId(name) if name in SHARED else ChannelId(name, TRACK)
