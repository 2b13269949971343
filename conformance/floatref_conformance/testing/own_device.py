"""A vendor's object in the tests' own process, held to what a `python:` device is held to."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from floatref_conformance.devices.host import outcome
from floatref_conformance.devices.interface import Device
from floatref_conformance.errors import DeviceSkipped


@dataclass
class OwnDevice:
    """A device around an object; a factory's object is made when it is first asked.

    What the factory raises is a fault of the device, as in a `python:` device.

    Attributes:
        name: of the object's type or its factory, for reports.
        make: returns the object.
        closes: whether the object is closed at the end.
    """

    name: str
    make: Callable[[], Device]
    closes: bool
    _made: Device | None = None

    @classmethod
    def of(cls, device: Callable[[], Device] | Device) -> "OwnDevice":
        """Return the device that ``device`` makes, or is."""
        if isinstance(device, type) or not hasattr(device, "run"):
            factory = cast("Callable[[], Device]", device)
            return cls(getattr(factory, "__name__", repr(factory)), factory, closes=True)
        one = cast("Device", device)
        return cls(type(one).__name__, lambda: one, closes=False)

    @property
    def _object(self) -> Device:
        if self._made is None:
            self._made = self.make()
        return self._made

    def describe(self) -> Mapping[str, Any]:
        """Return what the object says of itself."""
        return self._object.describe()

    def run(self, recording: Path, profile: Path) -> None:
        """Let the object run; DeviceSkipped if it returns ``{"skipped": …}``."""
        run: Callable[[Path, Path], object] = self._object.run
        told = outcome(run(recording, profile))
        if "skipped" in told:
            raise DeviceSkipped(told["skipped"])

    def close(self) -> None:
        """Close the object, if it is this device's own and can be closed."""
        ending = getattr(self._made, "close", None)
        if self.closes and ending is not None:
            ending()
