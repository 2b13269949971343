"""Inject a fault into a stretch of a recording, and describe its place and length."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.sameness.change import Numbers, number

DISTANCE = "distance"
SampleFault = Callable[[FloatArray, slice], None]
"""Changes the samples of a slice, or more of them, in place."""


@dataclass(frozen=True, eq=False)
class Faulty:
    """A recording with a fault in it, and where.

    Attributes:
        recording: what the device is given.
        extent_m: distance travelled while the fault lasted, in m.
        at_m: place where it began, in m.
        shift_m: error of the encoder's distance from then on, in m.
    """

    recording: Recording
    extent_m: float
    at_m: float
    shift_m: float = 0.0


Fault = Callable[[Recording, Numbers], Faulty]
"""Returns a recording with a fault, with the numbers of a case."""


def lose(values: FloatArray, where: slice) -> None:
    """Remove all samples."""
    values[where] = np.nan


def hold(values: FloatArray, where: slice) -> None:
    """Repeat the first sample."""
    values[where] = values[where.start]


def dropout(name: str) -> Fault:
    """Return the fault of a channel that is missing for ``length_s``, at least one sample."""
    return lambda recording, numbers: inject_locally(recording, numbers, name, lose)


def stuck(name: str) -> Fault:
    """Return the fault of a channel that repeats one reading for ``length_s``."""
    return lambda recording, numbers: inject_locally(recording, numbers, name, hold)


def saturation(name: str) -> Fault:
    """Return the fault of an accelerometer that is saturated for ``length_s``.

    It reads ``full_scale_g``, of either sign.
    """

    def inject(recording: Recording, numbers: Numbers) -> Faulty:
        end = number(numbers, "full_scale_g") * STANDARD_GRAVITY

        def pin(values: FloatArray, where: slice) -> None:
            values[where] = end

        return inject_locally(recording, numbers, name, pin)

    return inject


def times_of(recording: Recording, numbers: Numbers) -> tuple[float, float]:
    """Return the times in s when the fault begins and ends."""
    encoder = recording.channel(DISTANCE)
    at = int(np.searchsorted(encoder.values, number(numbers, "at_m")))
    begin_s = float(encoder.times_s[min(at, encoder.values.size - 1)])
    return begin_s, begin_s + number(numbers, "length_s")


def inject_locally(recording: Recording, numbers: Numbers, name: str, fault: SampleFault) -> Faulty:
    """Return ``recording`` with channel ``name`` of the first wheel path faulty."""
    begin_s, end_s = times_of(recording, numbers)
    channel = recording.channel(name, recording.tracks[0])
    faulty = replace_values(
        recording, name, channel.id.track, change_samples(channel, begin_s, end_s, fault).values
    )
    return measure_extent(faulty, recording, numbers, end_s)


def change_samples(channel: Channel, begin_s: float, end_s: float, fault: SampleFault) -> Channel:
    """Return ``channel``, faulty from ``begin_s`` up to ``end_s``, at least one sample."""
    times = channel.times_s
    first = int(np.searchsorted(times, begin_s))
    last = max(int(np.searchsorted(times, end_s)), first + 1)
    values = np.array(channel.values)
    if first < values.size:
        fault(values, slice(first, last))
    return Channel.of(channel.id.name, values, channel.clock, channel.id.track)


def measure_extent(faulty: Recording, whole: Recording, numbers: Numbers, end_s: float) -> Faulty:
    """Return ``faulty``, made of ``whole``, with the distance travelled until ``end_s``."""
    encoder, at_m = whole.channel(DISTANCE), number(numbers, "at_m")
    extent_m = float(np.interp(end_s, encoder.times_s, encoder.values)) - at_m
    return Faulty(faulty, max(extent_m, 0.0), at_m)


def replace_values(
    recording: Recording, name: str, track: str | None, values: FloatArray
) -> Recording:
    """Return ``recording`` with other ``values`` in channel ``name`` of ``track``."""
    channels = tuple(
        Channel.of(name, values, c.clock, track) if c.id == (name, track) else c
        for c in recording.channels
    )
    return replace(recording, channels=channels)
