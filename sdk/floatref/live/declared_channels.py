"""The channels of a stream: their names and clocks, stated before the first sample arrives."""

from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.kernels.gathered import copy_sound
from floatref.values.arrays import FloatArray, frozen
from floatref.values.channels import CHANNELS, ChannelId, channel_spec
from floatref.values.clock import LATEST_S, StampedClock, UniformClock
from floatref.values.display.short_text import shorten
from floatref.values.display.similar_names import suggest
from floatref.values.plain import numbers
from floatref.values.recording import Channel, Recording, Setup

FLOAT = np.dtype(np.float64)
LEAPS_S = 86_400.0
"""Largest step of the times of a channel in s."""
Declared = float | UniformClock | None
"""A rate in Hz, a clock, or None for samples that come with their times."""
Samples = ArrayLike | tuple[ArrayLike, ArrayLike]
"""Samples of a channel with a rate; times in s and samples of one without."""


def name_channel(given: str | ChannelId) -> ChannelId:
    """Return the channel called "name" or "track.name"; InputError for an unknown name."""
    if isinstance(given, ChannelId):
        channel_spec(given.name)
        return given
    track, _, name = str(given).rpartition(".")
    if name not in CHANNELS:
        raise InputError(f"channel {given}: unknown name; {suggest(name, CHANNELS, 'known:')}")
    return ChannelId(name, track or None)


def read_declarations(
    channels: Mapping[Any, Declared],
) -> dict[ChannelId, UniformClock | None]:
    """Return the clock of every channel; None where samples come with their times.

    Raises InputError without channels, for an unknown or repeated name and an impossible rate.
    """
    found: dict[ChannelId, UniformClock | None] = {}
    for given, declared in channels.items():
        name = name_channel(given)
        if name in found:
            raise InputError(f"channel {name}: given twice")
        found[name] = _read_clock(name, declared)
    if not found:
        raise InputError("the stream has no channels; name each with its rate in Hz")
    return found


def _read_clock(name: ChannelId, declared: Declared) -> UniformClock | None:
    if declared is None or isinstance(declared, UniformClock):
        return declared
    if isinstance(declared, StampedClock):
        raise InputError(
            f"channel {name}: is declared with the times of its samples; declare None, and push "
            "(times in s, samples)"
        )
    if isinstance(declared, bool) or not isinstance(declared, Real):
        raise InputError(
            f"channel {name}: {shorten(repr(declared))} is no clock; give a rate in Hz, a "
            "UniformClock, or None for samples with times"
        )
    try:
        return UniformClock.of(float(declared))
    except InputError as error:
        raise InputError(f"channel {name}: {error}") from error


def example_of(clocks: Mapping[ChannelId, UniformClock | None], setup: Setup) -> Recording:
    """Return a recording of one missing sample in each channel, for what only asks for names."""
    once = np.full(1, np.nan)
    channels = (
        Channel(name, once, StampedClock(np.zeros(1)) if clock is None else clock)
        for name, clock in clocks.items()
    )
    return Recording(tuple(channels), setup)


@dataclass(frozen=True, eq=False)
class Piece:
    """Samples of one channel, and their times in s if it has no rate; shape (N,) each."""

    values: FloatArray
    times_s: FloatArray | None = None


class Entrance:
    """Checks samples before they are accepted, so that a refused push changes nothing."""

    def __init__(self, clocks: Mapping[ChannelId, UniformClock | None]) -> None:
        """Accept samples of the channels with these clocks."""
        load_kernel()
        self._clocks = clocks
        # A push asks for the name of every channel: it is looked up, not read again.
        self._names: dict[object, ChannelId] = {name: name for name in clocks}
        self._names |= {str(name): name for name in clocks}
        self.latest_s: dict[ChannelId, float] = {}

    def check(self, samples: Mapping[Any, Samples]) -> dict[ChannelId, Piece]:
        """Return the samples by channel, in arrays of their own.

        Raises InputError for a channel that was not declared, infinite samples, arrays that do not
        fit, and times that do not increase.
        """
        found = {}
        for given, piece in samples.items():
            name = self._known(given)
            found[name] = self._piece(name, piece)
        for name, checked in found.items():
            if checked.times_s is not None and checked.times_s.size:
                self.latest_s[name] = float(checked.times_s[-1])
        return found

    def _known(self, given: str | ChannelId) -> ChannelId:
        known = self._names.get(given)
        if known is not None:
            return known
        name = name_channel(given)
        if name not in self._clocks:
            here = ", ".join(map(str, self._clocks))
            raise InputError(f"channel {name}: was not declared; the stream has {here}")
        return name

    def _piece(self, name: ChannelId, given: Samples) -> Piece:
        if self._clocks[name] is not None:
            return Piece(_array(name, given))
        if not isinstance(given, tuple) or len(given) != 2:
            raise InputError(f"channel {name}: has no rate; give (times in s, samples)")
        times, values = _array(f"{name}: times", given[0]), _array(name, given[1])
        if times.size != values.size:
            raise InputError(f"channel {name}: {values.size} samples but {times.size} time stamps")
        if not self._go_on(name, times):
            self._check_times(name, times)
        return Piece(values, times)

    def _go_on(self, name: ChannelId, times: FloatArray) -> bool:
        """Return whether ``times`` follow those before, as nearly all do: a few cheap questions."""
        before = self.latest_s.get(name)
        if before is None or not times.size:
            return False
        first, last = float(times[0]), float(times[-1])
        follows = before < first <= last <= min(before + LEAPS_S, LATEST_S)
        return follows and (times.size == 1 or bool((times[1:] > times[:-1]).all()))

    def _check_times(self, name: ChannelId, times: FloatArray) -> None:
        try:
            StampedClock(times)
        except InputError as error:
            raise InputError(f"channel {name}: {error}") from error
        before = self.latest_s.get(name, times[0] - 1.0 if times.size else 0.0)
        steps = np.diff(times, prepend=before)
        if times.size and steps[0] <= 0.0:
            raise InputError(
                f"channel {name}: time {times[0]:.9g} s comes after {before:.9g} s was pushed; "
                "push the samples of a channel in order, each once"
            )
        if times.size and steps.max() > LEAPS_S:
            at_s = float(times[steps.argmax()])
            raise InputError(
                f"channel {name}: time {at_s:.9g} s is more than a day behind the one before; "
                "begin another stream"
            )


def is_plain(values: Any) -> TypeGuard[FloatArray]:
    """Return whether ``values`` can be copied without further questions."""
    if type(values) is not np.ndarray or values.ndim != 1 or values.dtype is not FLOAT:
        return False
    return values.flags.c_contiguous


def load_kernel() -> None:
    """Compile or load the kernel for both kinds of arrays, before the first push waits for it."""
    own = np.empty(0)
    for values in (own, frozen(own)):
        copy_sound(values, own, 0)


def _array(name: object, given: Any) -> FloatArray:
    if is_plain(given):
        own = np.empty(given.size)
        if copy_sound(given, own, 0):
            own.flags.writeable = False
            return own
    array = numbers(f"channel {name}", given)
    if array.ndim != 1:
        raise InputError(f"channel {name}: shape {array.shape}; give one dimension, shape (N,)")
    # The caller may write the next samples into the same memory.
    return frozen(np.array(array))
