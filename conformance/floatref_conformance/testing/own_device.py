"""A vendor's object in the process of the tests, with the rules of a `python:` device."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from floatref_conformance.devices.host import outcome
from floatref_conformance.devices.interface import Device
from floatref_conformance.errors import DeviceSkipped


@dataclass
class OwnDevice:
    """A device around an object; a factory is called at the first use of its object.

    An exception of the factory is a fault of the device, as for a `python:` device.

    Attributes:
        name: name of the object's type or of its factory, for reports.
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
        """Return the object's description of itself."""
        return self._object.describe()

    def run(self, recording: Path, profile: Path) -> None:
        """Let the object run; DeviceSkipped if it returns ``{"skipped": …}``."""
        run: Callable[[Path, Path], object] = self._object.run
        answer = outcome(run(recording, profile))
        if "skipped" in answer:
            raise DeviceSkipped(answer["skipped"])

    def close(self) -> None:
        """Close the object, if this device made it and it has a method close."""
        ending = getattr(self._made, "close", None)
        if self.closes and ending is not None:
            ending()
