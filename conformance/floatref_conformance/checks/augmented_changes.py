"""What must not matter to devices with an inertial unit or a GNSS receiver."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.change import Change, Numbers, each, number, raised
from floatref_conformance.devices.interface import CAPABILITIES
from floatref_conformance.proving_ground.scenario import Scenario

SLOPE, UNIT_BIAS = "slope", "imu-bias"


def other_datum(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with ``shift_m`` added to the heights of its receiver."""
    shift_m = number(numbers, "shift_m")
    return each(recording, lambda c: raised(c, shift_m) if c.id.name == "gnss_height" else c)


def fewer_readings(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with one of ``every`` readings of its receiver."""
    step = int(number(numbers, "every"))

    def thinned(channel: Channel) -> Channel:
        if channel.id.name not in CAPABILITIES["gnss"]:
            return channel
        clock = StampedClock.of(channel.times_s[::step])
        return replace(channel, values=channel.values[::step], clock=clock)

    return each(recording, thinned)


def other_unit_bias(recording: Recording, numbers: Numbers) -> Recording:
    """Return ``recording`` with offsets in its inertial unit.

    ``bias`` in m/s² is added to the horizontal forces, ``rate_bias`` in rad/s to the rates.
    """
    offsets = {"force": number(numbers, "bias"), "rate": number(numbers, "rate_bias")}

    def biased(channel: Channel) -> Channel:
        if channel.id.name not in CAPABILITIES["imu"]:
            return channel
        return raised(channel, offsets[channel.id.name.rpartition("_")[2]])

    return each(recording, biased)


def other_gyro_rate(scenario: Scenario, numbers: Numbers) -> Scenario:
    """Return ``scenario`` with its gyros sampled at ``gyro_rate_hz``."""
    return replace(scenario, gyro_rate_hz=number(numbers, "gyro_rate_hz"))


def other_slope(scenario: Scenario, numbers: Numbers) -> Scenario:
    """Return ``scenario`` on a road of ``grade_percent`` and ``cross_slope_percent``."""
    grade, cross = (number(numbers, n) for n in ("grade_percent", "cross_slope_percent"))
    return replace(scenario, grade_percent=grade, cross_slope_percent=cross)


IMU, GNSS = frozenset({"imu"}), frozenset({"gnss"})
AUGMENTED_CHANGES: Mapping[str, Change] = MappingProxyType(
    {
        "gnss-datum": Change("another datum of heights", recording=other_datum, needs=GNSS),
        "gnss-rate": Change("fewer readings of GNSS", recording=fewer_readings, needs=GNSS),
        "gyro-rate": Change("another rate of the gyros", scenario=other_gyro_rate, needs=IMU),
        UNIT_BIAS: Change("a bias of forces and rates", recording=other_unit_bias, needs=IMU),
        SLOPE: Change("a road that climbs and leans", scenario=other_slope, needs=IMU | GNSS),
    }
)
"""Changes of sensors that a device has by a capability, or of what these have to see."""
