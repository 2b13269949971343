"""Faults of inertial units, GNSS receivers and the sensors of a vehicle's response.

A recording without the channels is returned unchanged.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.faults.injection import (
    Fault,
    Faulty,
    SampleFault,
    change_samples,
    dropout,
    hold,
    lose,
    measure_extent,
    saturation,
    stuck,
    times_of,
)
from floatref_conformance.checks.sameness.change import (
    Numbers,
    change_each,
    number,
    replace_samples,
)
from floatref_conformance.devices.interface import CAPABILITIES

HEIGHT, QUALITY = "gnss_height", "gnss_quality"
RATES = ("roll_rate", "pitch_rate", "yaw_rate")
NONE, SINGLE, FLOAT = 0.0, 1.0, 5.0
"""Values of `gnss_quality`."""
WANDER_S = 40.0
"""Period in s in which heights without fixed ambiguities wander."""


def outage(recording: Recording, numbers: Numbers) -> Faulty:
    """Leave the receiver without a fix for ``length_s``."""
    everything = dict.fromkeys(CAPABILITIES["gnss"], lose)
    return _for_a_while(recording, numbers, {**everything, QUALITY: _to(NONE)})


def wrong_fix(recording: Recording, numbers: Numbers) -> Faulty:
    """Add ``size_m`` to the receiver's height for ``length_s``, with a worse quality."""
    size_m = number(numbers, "size_m")

    def lift(values: FloatArray, where: slice) -> None:
        values[where] += size_m

    return _for_a_while(recording, numbers, {HEIGHT: lift, QUALITY: _to(SINGLE)})


def float_solution(recording: Recording, numbers: Numbers) -> Faulty:
    """Lose the fixed ambiguities for ``length_s``: the height moves by ``size_m``, and back.

    The quality shows it.
    """
    size_m = number(numbers, "size_m")

    def wander(values: FloatArray, where: slice) -> None:
        part = values[where]
        part += size_m * np.sin(np.linspace(0.0, np.pi, part.size)) ** 2

    return _for_a_while(recording, numbers, {HEIGHT: wander, QUALITY: _to(FLOAT)})


def never_fixed(recording: Recording, numbers: Numbers) -> Faulty:
    """The receiver never fixes its ambiguities, and its height wanders by ``size_m``.

    No more than usual may be flagged: a profiler works without a receiver.
    """
    size_m = number(numbers, "size_m")

    def change(channel: Channel) -> Channel:
        if channel.id.name == QUALITY:
            return replace_samples(channel, np.full(channel.values.size, FLOAT))
        if channel.id.name == HEIGHT:
            turns = channel.times_s / WANDER_S
            wander = size_m * np.sin(2 * np.pi * turns)
            return replace_samples(channel, channel.values + wander)
        return channel

    if recording.find(QUALITY) is None:
        return Faulty(recording, 0.0, 0.0)
    return Faulty(change_each(recording, change), 0.0, 0.0)


def jump(recording: Recording, numbers: Numbers) -> Faulty:
    """Add ``size_m`` to all heights of the receiver from one fixed reading on."""
    size_m = number(numbers, "size_m")

    def lift(values: FloatArray, where: slice) -> None:
        values[where.start :] += size_m

    return _for_a_while(recording, {**numbers, "length_s": 0.0}, {HEIGHT: lift})


def stuck_height(recording: Recording, numbers: Numbers) -> Faulty:
    """Repeat one height of the receiver for ``length_s``, with the quality of a fixed one."""
    return _for_a_while(recording, numbers, {HEIGHT: hold})


def gyro_gap(recording: Recording, numbers: Numbers) -> Faulty:
    """Lose all rates for ``length_s``."""
    return _for_a_while(recording, numbers, dict.fromkeys(RATES, lose))


def imu_flicker(recording: Recording, numbers: Numbers) -> Faulty:
    """Lose ``count`` single samples of every channel of the inertial unit over ``span_m``."""
    at_m, count = number(numbers, "at_m"), int(number(numbers, "count"))
    span_m = number(numbers, "span_m")
    faulty = recording
    for n in range(count):
        there = {**numbers, "at_m": at_m + n * span_m / count, "length_s": 0.0}
        faulty = _for_a_while(faulty, there, dict.fromkeys(CAPABILITIES["imu"], lose)).recording
    return Faulty(faulty, span_m, at_m)


AUGMENTED: Mapping[str, Fault] = MappingProxyType(
    {
        "gnss-outage": outage,
        "gnss-wrong-fix": wrong_fix,
        "gnss-float": float_solution,
        "gnss-jump": jump,
        "gnss-stuck": stuck_height,
        "gnss-never-fixed": never_fixed,
        "gnss-outage-at-a-stop": outage,
        "imu-gyro-gap": gyro_gap,
        "imu-flicker": imu_flicker,
    }
)
"""Faults of sensors that a device has by a capability; its name is the first part of theirs."""


def _to(quality: float) -> SampleFault:
    def worsen(values: FloatArray, where: slice) -> None:
        values[where] = quality

    return worsen


def _for_a_while(
    recording: Recording, numbers: Numbers, faults: Mapping[str, SampleFault]
) -> Faulty:
    """Return ``recording`` with the channels named in ``faults`` faulty for ``length_s``."""
    begin_s, end_s = times_of(recording, numbers)

    def inject(channel: Channel) -> Channel:
        fault = faults.get(channel.id.name)
        return channel if fault is None else change_samples(channel, begin_s, end_s, fault)

    there = any(channel.id.name in faults for channel in recording.channels)
    faulty = change_each(recording, inject) if there else recording
    return measure_extent(faulty, recording, numbers, end_s)


WHEEL, BODY = "unsprung_specific_force", "sprung_specific_force"
DEFLECTION = "suspension_deflection"

RESPONSE: Mapping[str, Fault] = MappingProxyType(
    {
        "response-wheel-dropout": dropout(WHEEL),
        "response-wheel-stuck": stuck(WHEEL),
        "response-wheel-saturation": saturation(WHEEL),
        "response-body-dropout": dropout(BODY),
        "response-deflection-dropout": dropout(DEFLECTION),
        "response-deflection-stuck": stuck(DEFLECTION),
    }
)
"""Faults of sensors that a device has by the capability `response`."""
