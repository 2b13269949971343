"""The device interface: a device says what it is, and turns a recording into a profile."""

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
}
"""The channels that each capability gives a device beside the nominal ones."""
RESPONSE = "response"
"""The architecture without a height sensor, and the capability that it has to declare."""
HEIGHT = "height"
"""The height sensor: its channel, and what a check needs that asks for it."""
WHEEL = "unsprung_specific_force"
"""The channel of every wheel path whose profile is owed without a height sensor."""
NEEDS: Mapping[str, str] = {HEIGHT: "a height sensor", **{c: c for c in CAPABILITIES}}
"""What a check may need of a device, and in words."""


class Device(Protocol):
    """What is judged. Whatever these two raise is a fault of the device."""

    def describe(self) -> Mapping[str, Any]:
        """Return ``name``, ``version``, ``architecture`` and ``capabilities``."""

    def run(self, recording: Path, profile: Path) -> None:
        """Read ``recording`` (a recording.json) and create the directory ``profile``."""


@dataclass(frozen=True)
class Description:
    """What a device says of itself, once it has been found sound."""

    name: str
    version: str
    architecture: str
    capabilities: tuple[str, ...]

    @classmethod
    def of(cls, said: object) -> "Description":
        """Return the description that ``said`` holds; DeviceError if it is unusable."""
        if not isinstance(said, Mapping):
            raise DeviceError(f"describes itself by a {type(said).__name__}, not by an object")
        for key in ("name", "version", "architecture"):
            if not isinstance(said.get(key), str):
                raise DeviceError(f"describes itself without a {key}")
        if said["architecture"] not in ARCHITECTURES:
            raise DeviceError(
                f"architecture {said['architecture']!r}; known: {', '.join(ARCHITECTURES)}"
            )
        capabilities = _capabilities(said.get("capabilities"))
        check_response(said["architecture"], capabilities)
        return cls(said["name"], said["version"], said["architecture"], capabilities)

    @property
    def has_height(self) -> bool:
        """Whether the device has a height sensor: one of architecture response has none."""
        return self.architecture != RESPONSE

    @property
    def channels(self) -> frozenset[str]:
        """Names of the channels that the device may have."""
        channels = NOMINAL_CHANNELS.union(*(CAPABILITIES[c] for c in self.capabilities))
        return channels if self.has_height else channels - {HEIGHT}

    @property
    def meets(self) -> frozenset[str]:
        """What of `NEEDS` the device has: its capabilities, and most have a height sensor."""
        return frozenset(self.capabilities).union((HEIGHT,) if self.has_height else ())

    @property
    def owes(self) -> str:
        """The channel whose wheel paths the device has to deliver."""
        return HEIGHT if self.has_height else WHEEL


def check_response(architecture: str, capabilities: Collection[str]) -> None:
    """Raise DeviceError for a device of architecture response without its channels."""
    if architecture == RESPONSE and RESPONSE not in capabilities:
        raise DeviceError(
            f"architecture {RESPONSE} without capability {RESPONSE}; declare it, the road is "
            "estimated from its channels"
        )


def _capabilities(said: object) -> tuple[str, ...]:
    if not isinstance(said, (list, tuple)):
        raise DeviceError("describes itself without a list of capabilities")
    for capability in said:
        if not isinstance(capability, str) or capability not in CAPABILITIES:
            raise DeviceError(f"capability {capability!r}; known: {', '.join(CAPABILITIES)}")
    return tuple(said)


def visible(recording: Recording, channels: frozenset[str]) -> Recording:
    """Return what a device may see of ``recording``: its channels, and no telling name.

    What is known of the vehicle goes with the channels of its response.
    """
    seen = tuple(c for c in recording.channels if c.id.name in channels)
    setup = recording.setup
    if channels.isdisjoint(CAPABILITIES[RESPONSE]):
        setup = replace(setup, vehicle=None)
    return Recording(seen, setup)


@dataclass(frozen=True)
class DeviceEntry:
    """One device that comes with a kind, and the checks that it must fail, if any."""

    name: str
    summary: str
    fails: tuple[str, ...] = ()


@dataclass(frozen=True)
class DeviceKind:
    """A kind of device: the part of a SPEC before its colon, and how to make one.

    ``make`` gets the part after the colon and raises InputError if it names nothing;
    ``entries`` lists the devices that can be named, empty if they are the user's own.
    """

    prefix: str
    argument: str
    make: Callable[[str], Device]
    entries: Callable[[], tuple[DeviceEntry, ...]] = tuple

    @property
    def usage(self) -> str:
        """How a SPEC of this kind is written."""
        return f"{self.prefix}:{self.argument}"
