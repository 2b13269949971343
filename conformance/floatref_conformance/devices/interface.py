"""The device interface: a device describes itself, and turns a recording into a profile."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol

from floatref.values.recording import Recording
from floatref_conformance.errors import DeviceError

ARCHITECTURES = ("temporal", "spatial", "response")
NOMINAL_CHANNELS = frozenset({"vertical_specific_force", "height", "distance"})
CAPABILITIES: Mapping[str, frozenset[str]] = {
    "imu": frozenset(
        {
            "longitudinal_specific_force",
            "lateral_specific_force",
            "roll_rate",
            "pitch_rate",
            "yaw_rate",
        }
    ),
    "gnss": frozenset(
        {
            "gnss_height",
            "gnss_vertical_velocity",
            "gnss_pitch",
            "gnss_roll",
            "gnss_quality",
            "gnss_latitude",
            "gnss_longitude",
        }
    ),
    "response": frozenset(
        {
            "unsprung_specific_force",
            "rear_unsprung_specific_force",
            "sprung_specific_force",
            "equipment_specific_force",
            "suspension_deflection",
            "rear_suspension_deflection",
            "unsprung_displacement",
            "rear_unsprung_displacement",
            "sprung_displacement",
            "equipment_displacement",
            "unsprung_velocity",
            "rear_unsprung_velocity",
            "sprung_velocity",
            "equipment_velocity",
            "pitch_angle",
            "roll_angle",
            "pitch_acceleration",
            "roll_acceleration",
        }
    ),
    "encoders": frozenset({"wheel_distance"}),
    "gnss-speed": frozenset({"gnss_speed"}),
    "wheel-speed": frozenset({"wheel_speed"}),
    "optical": frozenset({"optical_distance"}),
}
"""The channels that each capability adds to the nominal ones."""
RESPONSE = "response"
"""The architecture without a height sensor, and the capability that it must declare."""
HEIGHT = "height"
"""The height sensor: the name of its channel, and of the need of a check."""
WHEEL = "unsprung_specific_force"
"""Without a height sensor, a profile is required of each wheel path with this channel."""
NEEDS: Mapping[str, str] = {HEIGHT: "a height sensor", **{c: c for c in CAPABILITIES}}
"""Everything that a check may need of a device, with its description."""


class Device(Protocol):
    """The object that is judged. An exception of either method is a fault of the device."""

    def describe(self) -> Mapping[str, Any]:
        """Return ``name``, ``version``, ``architecture`` and ``capabilities``."""

    def run(self, recording: Path, profile: Path) -> None:
        """Read ``recording`` (a recording.json) and create the directory ``profile``."""


@dataclass(frozen=True)
class Description:
    """A device's description of itself, verified."""

    name: str
    version: str
    architecture: str
    capabilities: tuple[str, ...]

    @classmethod
    def of(cls, answer: object) -> "Description":
        """Return the description in ``answer``; DeviceError if it is unusable."""
        if not isinstance(answer, Mapping):
            raise DeviceError(
                f"gives a description that is a {type(answer).__name__}, not an object"
            )
        for key in ("name", "version", "architecture"):
            if not isinstance(answer.get(key), str):
                raise DeviceError(f"gives a description without a {key}")
        if answer["architecture"] not in ARCHITECTURES:
            raise DeviceError(
                f"architecture {answer['architecture']!r}; known: {', '.join(ARCHITECTURES)}"
            )
        capabilities = _capabilities(answer.get("capabilities"))
        check_response(answer["architecture"], capabilities)
        return cls(answer["name"], answer["version"], answer["architecture"], capabilities)

    @property
    def has_height(self) -> bool:
        """Whether the device has a height sensor: all architectures except response."""
        return self.architecture != RESPONSE

    @property
    def channels(self) -> frozenset[str]:
        """Names of the channels that the device may receive."""
        channels = NOMINAL_CHANNELS.union(*(CAPABILITIES[c] for c in self.capabilities))
        return channels if self.has_height else channels - {HEIGHT}

    @property
    def meets(self) -> frozenset[str]:
        """The `NEEDS` that the device meets: its capabilities, and the height sensor."""
        return frozenset(self.capabilities).union((HEIGHT,) if self.has_height else ())

    @property
    def owes(self) -> str:
        """The channel of the wheel paths that the device has to deliver."""
        return HEIGHT if self.has_height else WHEEL


def check_response(architecture: str, capabilities: Collection[str]) -> None:
    """Raise DeviceError for a device of architecture response without its channels."""
    if architecture == RESPONSE and RESPONSE not in capabilities:
        raise DeviceError(
            f"architecture {RESPONSE} without capability {RESPONSE}; declare it, the road is "
            "estimated from its channels"
        )


def _capabilities(declared: object) -> tuple[str, ...]:
    if not isinstance(declared, (list, tuple)):
        raise DeviceError("gives a description without a list of capabilities")
    for capability in declared:
        if not isinstance(capability, str) or capability not in CAPABILITIES:
            raise DeviceError(f"capability {capability!r}; known: {', '.join(CAPABILITIES)}")
    return tuple(declared)


def visible(recording: Recording, channels: frozenset[str]) -> Recording:
    """Return the part of ``recording`` that a device may see: its channels, without a name.

    The setup contains the vehicle only for a device with channels of the vehicle's response.
    """
    seen = tuple(c for c in recording.channels if c.id.name in channels)
    setup = recording.setup
    if channels.isdisjoint(CAPABILITIES[RESPONSE]):
        setup = replace(setup, vehicle=None)
    return Recording(seen, setup)


@dataclass(frozen=True)
class DeviceEntry:
    """One device of a kind, and the ids of the checks that it must fail, if any."""

    name: str
    summary: str
    fails: tuple[str, ...] = ()


@dataclass(frozen=True)
class DeviceKind:
    """A kind of device: the part of a SPEC before its colon, and the function that makes one.

    ``make`` gets the part after the colon and raises InputError if it names no device;
    ``entries`` lists the devices that can be named; empty if they are the user's own.
    """

    prefix: str
    argument: str
    make: Callable[[str], Device]
    entries: Callable[[], tuple[DeviceEntry, ...]] = tuple

    @property
    def usage(self) -> str:
        """How a SPEC of this kind is written."""
        return f"{self.prefix}:{self.argument}"
