"""A change that must not affect the result, and the numbers of a case that define it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.case import Number
from floatref_conformance.devices.interface import CAPABILITIES, NEEDS
from floatref_conformance.proving_ground.scenario import LIMITS, Scenario

Numbers = Mapping[str, Number]
RANGES: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "samples": (0, 1e6),
        "bias": (-10.0, 10.0),
        "rate_bias": (-0.1, 0.1),
        "shift_s": (-1e9, 1e9),
        "shift_m": (-1e7, 1e7),
        "factor": (0.01, 100.0),
        "every": (1, 100),
        "at_m": LIMITS["event_at_m"],
        "length_s": (0.0, 600.0),
        "span_m": (0.0, 1e4),
        "count": (1, 1000),
        "side": (-1, 1),
        "size_m": (-100.0, 100.0),
        "full_scale_g": (-1000.0, 1000.0),
        **{
            name: LIMITS[name]
            for name in ("rate_hz", "gyro_rate_hz", "grade_percent", "cross_slope_percent")
        },
    }
)
"""Smallest and largest value of every number that a change or a fault may have."""


@dataclass(frozen=True)
class Change:
    """A change that must not affect the result, and the inverse change of the result.

    Attributes:
        says: description of the change.
        scenario: changes the drive, the road or the sensors.
        recording: changes the recording.
        truth: moves the truth to the changed axis of distance.
        profile: undoes the change in the result.
        needs: the `NEEDS` without which the change has no effect on a device.
    """

    says: str
    scenario: Callable[[Scenario, Numbers], Scenario] = lambda scenario, _: scenario
    recording: Callable[[Recording, Numbers], Recording] = lambda recording, _: recording
    truth: Callable[[Profile, Numbers], Profile] = lambda truth, _: truth
    profile: Callable[[Profile, Numbers], Profile] = lambda profile, _: profile
    needs: frozenset[str] = frozenset()


def number(numbers: Numbers, name: str) -> float:
    """Return number ``name`` of a case's variation; InputError if it is invalid."""
    value = numbers.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"variation {name} is {value!r}; give a number")
    low, high = RANGES[name]
    if not low <= value <= high:
        raise InputError(f"variation {name} is {value!r}; it must lie between {low:g} and {high:g}")
    return float(value)


def check_equipped(recording: Recording, needs: frozenset[str], what: str) -> None:
    """Raise InputError if ``recording`` has no channel of a sensor that ``what`` needs."""
    names = {channel.id.name for channel in recording.channels}
    for need in sorted(needs):
        if names.isdisjoint(CAPABILITIES.get(need, (need,))):
            raise InputError(
                f"variation {what}: needs {NEEDS[need]}, which the device does not have"
            )


def change_each(recording: Recording, change: Callable[[Channel], Channel]) -> Recording:
    """Return ``recording`` with ``change`` applied to each of its channels."""
    return replace(recording, channels=tuple(change(c) for c in recording.channels))


def add_offset(channel: Channel, offset: float) -> Channel:
    """Return ``channel`` with ``offset`` added to its samples, in its unit."""
    return replace_samples(channel, channel.values + offset)


def replace_samples(channel: Channel, values: FloatArray) -> Channel:
    """Return ``channel`` with other ``values`` at the same times."""
    return Channel.of(channel.id.name, values, channel.clock, channel.id.track)
