"""Faults of sensors and recorders in the field, injected into a recording of known truth.

A fault begins where the vehicle passes ``at_m`` of the encoder's distance. Sensors of a wheel path
are faulty in the first one; all wheel paths use the same encoder.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock
from floatref.values.display.similar_names import suggest
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.faults.augmented_faults import AUGMENTED, RESPONSE
from floatref_conformance.checks.faults.injection import (
    DISTANCE,
    Fault,
    Faulty,
    change_samples,
    dropout,
    hold,
    inject_locally,
    lose,
    measure_extent,
    replace_values,
    saturation,
    stuck,
    times_of,
)
from floatref_conformance.checks.sameness.change import Numbers, number
from floatref_conformance.devices.interface import HEIGHT, NEEDS

FORCE = "vertical_specific_force"
BEYOND_M = 0.05
"""Distance in m from the extreme readings of the laser to the end of its range."""
COUNTS_APART_M = 0.5
"""Distance in m between the readings that are too low."""
ROLLING = 0.8
"""Share of a standstill in which the vehicle rolls back and forth."""


def flicker(recording: Recording, numbers: Numbers) -> Faulty:
    """Lose ``count`` stretches of ``length_s`` of the laser over ``span_m``."""
    at_m, count = number(numbers, "at_m"), int(number(numbers, "count"))
    span_m = number(numbers, "span_m")
    faulty = recording
    for n in range(count):
        there = {**numbers, "at_m": at_m + n * span_m / count}
        faulty = inject_locally(faulty, there, HEIGHT, lose).recording
    return Faulty(faulty, span_m, at_m)


def out_of_range(recording: Recording, numbers: Numbers) -> Faulty:
    """Pin the laser to the far (``side`` 1) or near (-1) end of its range for ``length_s``."""
    side = number(numbers, "side")

    def pin(values: FloatArray, where: slice) -> None:
        end = np.nanmax(values) if side > 0 else np.nanmin(values)
        values[where] = end + side * BEYOND_M

    return inject_locally(recording, numbers, HEIGHT, pin)


def gap(recording: Recording, numbers: Numbers) -> Faulty:
    """Lose all channels for ``length_s``: their samples are missing."""
    begin_s, end_s = times_of(recording, numbers)
    channels = tuple(change_samples(c, begin_s, end_s, lose) for c in recording.channels)
    return measure_extent(replace(recording, channels=channels), recording, numbers, end_s)


def gap_in_time(recording: Recording, numbers: Numbers) -> Faulty:
    """Lose all channels for ``length_s``: samples and time stamps are removed."""
    begin_s, end_s = times_of(recording, numbers)

    def cut(channel: Channel) -> Channel:
        times = channel.times_s
        outside = (times < begin_s) | (times >= end_s)
        return replace(
            channel, values=channel.values[outside], clock=StampedClock.of(times[outside])
        )

    channels = tuple(cut(c) for c in recording.channels)
    return measure_extent(replace(recording, channels=channels), recording, numbers, end_s)


def leap(recording: Recording, numbers: Numbers) -> Faulty:
    """The encoder counts ``size_m`` that were not travelled."""
    size_m = number(numbers, "size_m")

    def add(values: FloatArray, where: slice) -> None:
        values[where.start :] += size_m

    faulty = inject_locally(recording, {**numbers, "length_s": 0.0}, DISTANCE, add)
    return replace(faulty, extent_m=0.0, shift_m=size_m)


def silence(recording: Recording, numbers: Numbers) -> Faulty:
    """Hold the encoder for ``length_s``; then it has the true distance again."""
    return inject_locally(recording, numbers, DISTANCE, hold)


def lost_counts(recording: Recording, numbers: Numbers) -> Faulty:
    """Hold the encoder for ``length_s``; the distance of this time is never counted."""

    def lose(values: FloatArray, where: slice) -> None:
        values[where.stop :] -= values[min(where.stop, values.size - 1)] - values[where.start]
        hold(values, where)

    faulty = inject_locally(recording, numbers, DISTANCE, lose)
    return replace(faulty, shift_m=-faulty.extent_m)


def counts_back(recording: Recording, numbers: Numbers) -> Faulty:
    """Subtract ``size_m`` from ``count`` single samples of the encoder."""
    at_m, count = number(numbers, "at_m"), int(number(numbers, "count"))
    size_m = number(numbers, "size_m")
    encoder = recording.channel(DISTANCE)
    values = np.array(encoder.values)
    back = np.searchsorted(encoder.values, at_m + COUNTS_APART_M * np.arange(count))
    values[back[back < values.size]] -= size_m
    faulty = replace_values(recording, DISTANCE, None, values)
    return Faulty(faulty, COUNTS_APART_M * count, at_m)


def rolling_back(recording: Recording, numbers: Numbers) -> Faulty:
    """Roll ``size_m`` back and forth again at the longest standstill."""
    encoder = recording.channel(DISTANCE)
    moved = np.flatnonzero(np.diff(encoder.values, prepend=-np.inf, append=np.inf) > 0)
    longest = int(np.argmax(np.diff(moved)))
    first, last = moved[longest], moved[longest + 1]
    stationary = slice(first, last - int((1.0 - ROLLING) * (last - first)))
    values = np.array(encoder.values)
    there = np.linspace(0.0, np.pi, values[stationary].size)
    values[stationary] -= number(numbers, "size_m") * np.sin(there) ** 2
    return Faulty(replace_values(recording, DISTANCE, None, values), 0.0, float(values[first]))


SENSOR_FAULTS: Mapping[str, Fault] = MappingProxyType(
    {
        "laser-dropout": dropout(HEIGHT),
        "laser-flicker": flicker,
        "laser-stuck": stuck(HEIGHT),
        "laser-out-of-range": out_of_range,
        "accelerometer-dropout": dropout(FORCE),
        "accelerometer-saturation": saturation(FORCE),
        "gap": gap,
        "gap-in-time": gap_in_time,
        "encoder-dropout": dropout(DISTANCE),
        "encoder-leap": leap,
        "encoder-silence": silence,
        "encoder-lost-counts": lost_counts,
        "encoder-counts-back": counts_back,
        "encoder-rolling-back": rolling_back,
        **AUGMENTED,
        **RESPONSE,
    }
)
"""All faults by the name that a case's variation gives under ``fault``."""


def fault_of(numbers: Numbers) -> Fault:
    """Return the fault that a case's variation names; InputError if it is unknown."""
    name = numbers.get("fault")
    if name not in SENSOR_FAULTS:
        known = suggest(name, SENSOR_FAULTS, "known:")
        raise InputError(f"variation fault {name!r}: unknown; {known}")
    return SENSOR_FAULTS[str(name)]


def needs_of(fault: str) -> frozenset[str]:
    """Return the need of `NEEDS` for the faulty sensor; empty if every device has it."""
    part = fault.partition("-")[0]
    return frozenset({HEIGHT if part == "laser" else part}).intersection(NEEDS)
