"""The device interface: a device says what it is, and turns a recording into a profile."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
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
}
"""The channels that each capability gives a device beside the nominal ones."""


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
        return cls(said["name"], said["version"], said["architecture"], capabilities)

    @property
    def channels(self) -> frozenset[str]:
        """Names of the channels that the device may have."""
        return NOMINAL_CHANNELS.union(*(CAPABILITIES[c] for c in self.capabilities))


def _capabilities(said: object) -> tuple[str, ...]:
    if not isinstance(said, (list, tuple)):
        raise DeviceError("describes itself without a list of capabilities")
    for capability in said:
        if not isinstance(capability, str) or capability not in CAPABILITIES:
            raise DeviceError(f"capability {capability!r}; known: {', '.join(CAPABILITIES)}")
    return tuple(said)


def visible(recording: Recording, channels: frozenset[str]) -> Recording:
    """Return what a device may see of ``recording``: its channels, and no telling name."""
    seen = tuple(c for c in recording.channels if c.id.name in channels)
    return Recording(seen, recording.setup)


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
