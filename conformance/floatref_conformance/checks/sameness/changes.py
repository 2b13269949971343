"""Changes of a recording or a drive, but not of the road; they must not affect the result."""

from collections.abc import Mapping
from dataclasses import replace
from math import ceil
from types import MappingProxyType

import numpy as np

from floatref.errors import InputError
from floatref.values.clock import StampedClock
from floatref.values.display.similar_names import suggest
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.sameness.change import (
    Change,
    Numbers,
    add_offset,
    change_each,
    number,
)
from floatref_conformance.devices.interface import CAPABILITIES
from floatref_conformance.proving_ground.scenario import Scenario

SLOPE, UNIT_BIAS = "slope", "imu-bias"


def change_datum(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with ``shift_m`` added to the heights of its receiver."""
    shift_m = number(numbers, "shift_m")
    return change_each(
        recording, lambda c: add_offset(c, shift_m) if c.id.name == "gnss_height" else c
    )


def thin_readings(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with one of ``every`` readings of its receiver."""
    step = int(number(numbers, "every"))

    def thin(channel: Channel) -> Channel:
        if channel.id.name not in CAPABILITIES["gnss"]:
            return channel
        clock = StampedClock.of(channel.times_s[::step])
        return replace(channel, values=channel.values[::step], clock=clock)

    return change_each(recording, thin)


def add_unit_bias(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with offsets in its inertial unit.

    ``bias`` in m/s² is added to the horizontal forces, ``rate_bias`` in rad/s to the rates.
    """
    offsets = {"force": number(numbers, "bias"), "rate": number(numbers, "rate_bias")}

    def shift(channel: Channel) -> Channel:
        if channel.id.name not in CAPABILITIES["imu"]:
            return channel
        return add_offset(channel, offsets[channel.id.name.rpartition("_")[2]])

    return change_each(recording, shift)


def change_gyro_rate(scenario: Scenario, numbers: Numbers) -> Scenario:
    """Return ``scenario`` with its gyros sampled at ``gyro_rate_hz``."""
    return replace(scenario, gyro_rate_hz=number(numbers, "gyro_rate_hz"))


def change_slope(scenario: Scenario, numbers: Numbers) -> Scenario:
    """Return ``scenario`` on a road of ``grade_percent`` and ``cross_slope_percent``."""
    grade, cross = (number(numbers, n) for n in ("grade_percent", "cross_slope_percent"))
    return replace(scenario, grade_percent=grade, cross_slope_percent=cross)


IMU, GNSS = frozenset({"imu"}), frozenset({"gnss"})
AUGMENTED_CHANGES: Mapping[str, Change] = MappingProxyType(
    {
        "gnss-datum": Change("another datum of heights", recording=change_datum, needs=GNSS),
        "gnss-rate": Change("fewer readings of GNSS", recording=thin_readings, needs=GNSS),
        "gyro-rate": Change("another rate of the gyros", scenario=change_gyro_rate, needs=IMU),
        UNIT_BIAS: Change("a bias of forces and rates", recording=add_unit_bias, needs=IMU),
        SLOPE: Change("a road that climbs and leans", scenario=change_slope, needs=IMU | GNSS),
    }
)
"""Changes of sensors that a device has by a capability, or of what they measure."""


LATER = "later-start"
VERTICAL_FORCES = frozenset(
    {"vertical_specific_force", *(c for c in CAPABILITIES["response"] if c.endswith("_force"))}
)
EARLY = 1e-6
"""Tolerance for rounded times, in steps: an earlier sample counts as taken at that time."""


def start_later(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` without the first ``samples`` of the accelerometers' clock.

    Earlier samples of other channels are removed too.
    """
    force = next(c for c in recording.channels if c.id.name == "vertical_specific_force")
    begin_s = float(force.clock.times(1, int(number(numbers, "samples")))[0])
    return change_each(recording, lambda channel: _from(channel, begin_s))


def change_storage(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with a time stamp for every sample in place of rates."""
    return change_each(
        recording, lambda channel: replace(channel, clock=StampedClock.of(channel.times_s))
    )


def add_bias(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with ``bias`` in m/s² added to the vertical accelerometers."""

    def shift(channel: Channel) -> Channel:
        if channel.id.name not in VERTICAL_FORCES:
            return channel
        return add_offset(channel, number(numbers, "bias"))

    return change_each(recording, shift)


def shift_time(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with a time stamp for every sample, all ``shift_s`` later."""
    shift_s = number(numbers, "shift_s")
    return change_each(recording, lambda c: replace(c, clock=StampedClock.of(c.times_s + shift_s)))


def shift_distance(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with ``shift_m`` added to its distance."""

    def move(channel: Channel) -> Channel:
        if channel.id.name != "distance":
            return channel
        return add_offset(channel, number(numbers, "shift_m"))

    return change_each(recording, move)


def shift_truth(truth: Profile, numbers: Numbers) -> Profile:
    """Return ``truth`` on the axis of `shift_distance`."""
    return replace(truth, start_m=truth.start_m + number(numbers, "shift_m"))


def shift_back(profile: Profile, numbers: Numbers) -> Profile:
    """Return ``profile`` on the axis of distance from before `shift_distance`."""
    return replace(profile, start_m=profile.start_m - number(numbers, "shift_m"))


def raise_road(scenario: Scenario, numbers: Numbers) -> Scenario:
    """Return ``scenario`` with the height of its road multiplied by ``factor``."""
    return replace(scenario, iri_m_per_km=scenario.iri_m_per_km * number(numbers, "factor"))


def lower_profile(profile: Profile, numbers: Numbers) -> Profile:
    """Return ``profile``, which saw a `raise_road`, scaled back to the original road."""
    tracks = tuple(
        ProfileTrack.of(t.name, t.elevation / number(numbers, "factor"), t.valid)
        for t in profile.tracks
    )
    return replace(profile, tracks=tracks)


def change_rate(scenario: Scenario, numbers: Numbers) -> Scenario:
    """Return ``scenario`` with its accelerometers sampled at ``rate_hz``."""
    return replace(scenario, rate_hz=number(numbers, "rate_hz"))


def lengthen_stop(scenario: Scenario, numbers: Numbers) -> Scenario:
    """Return ``scenario`` with twice the time at a standstill."""
    return replace(scenario, dwell_s=2.0 * scenario.dwell_s)


CHANGES: Mapping[str, Change] = MappingProxyType(
    {
        LATER: Change("the recording begins later", recording=start_later),
        "clock-storage": Change("a time stamp for each sample", recording=change_storage),
        "accelerometer-bias": Change("a bias of the accelerometers", recording=add_bias),
        "clock-origin": Change("time stamps of another origin", recording=shift_time),
        "distance-origin": Change(
            "another origin of distance",
            recording=shift_distance,
            truth=shift_truth,
            profile=shift_back,
        ),
        "road-height": Change(
            "a road multiplied in height, ideal sensors", raise_road, profile=lower_profile
        ),
        "sample-rate": Change("another rate of the accelerometers", change_rate),
        "longer-stop": Change("twice the time at a standstill", lengthen_stop),
        **AUGMENTED_CHANGES,
    }
)
"""All changes by the name that a case's variation gives under ``change``."""


def change_of(numbers: Numbers) -> Change:
    """Return the change that a case's variation names; InputError if it is unknown."""
    name = numbers.get("change")
    if name not in CHANGES:
        known = suggest(name, CHANGES, "known:")
        raise InputError(f"variation change {name!r}: unknown; {known}")
    return CHANGES[str(name)]


def begins_later_m(before: Recording, after: Recording) -> float:
    """Return the distance in m that is missing at the beginning of ``after``."""
    return float(np.diff([r.channel("distance").values[0] for r in (before, after)])[0])


def _from(channel: Channel, begin_s: float) -> Channel:
    """Return the samples of ``channel`` from ``begin_s`` on."""
    clock = channel.clock
    if isinstance(clock, StampedClock):
        first = int(np.searchsorted(clock.times_s, begin_s))
        return replace(
            channel, values=channel.values[first:], clock=StampedClock.of(clock.times_s[first:])
        )
    first = max(0, ceil((begin_s - clock.start_s) * float(clock.rate) - EARLY))
    starts_s = float(clock.times(1, first)[0])
    return replace(channel, values=channel.values[first:], clock=replace(clock, start_s=starts_s))
