"""Devices in containers: an image whose program follows the protocol of programs."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref_conformance.devices.containers.engine import (
    Engine,
    check_folder,
    check_image,
    find_engine,
)
from floatref_conformance.devices.containers.running import RunningContainer
from floatref_conformance.devices.executable import limit_of
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.devices.process import readable
from floatref_conformance.errors import DeviceError

START_S = 60.0
"""Time in s for `start`: a container begins later than a program."""
STOP_S = 20.0
"""Time in s for `stop`, the removal of a container that ends by itself included."""


@dataclass(eq=False)
class ContainerDevice:
    """The program of an image; after a fault the container is removed and a new one started.

    It is not judged as a stream, whatever it declares: the judge does not see its memory.

    Attributes:
        image: the name that was given.
        digest: the SHA-256 of the image of that name when the device was made; this one runs, even
            if the name gets another image.
        engine: the command that runs it.
        timeout_s: time for `run` in s; None for 60 s plus twice the recording's length.
        start_s, stop_s: times for `start` and `stop`, in s.
        variables: names of the variables of the environment that it gets, and no others.
        confined: True; the device cannot read files of this machine.
    """

    image: str
    digest: str
    engine: Engine
    timeout_s: float | None = None
    start_s: float = START_S
    stop_s: float = STOP_S
    variables: tuple[str, ...] = ()
    confined: bool = field(default=True, init=False)
    _running: RunningContainer | None = field(default=None, init=False, repr=False)
    _description: Mapping[str, Any] | None = field(default=None, init=False, repr=False)

    def describe(self) -> Mapping[str, Any]:
        """Return the program's description of itself; DeviceError without a usable one."""
        return self._start().device

    def run(self, recording: Path, profile: Path) -> None:
        """Let the program process ``recording``; DeviceError, DeviceHung or DeviceSkipped."""
        self._start().run(recording, profile, limit_of(recording, self.timeout_s))

    def close(self) -> None:
        """Stop the program and remove its container; DeviceError if it does not stop properly."""
        running, self._running = self._running, None
        if running is not None and not running.is_over:
            running.stop(self.stop_s)

    def _start(self) -> RunningContainer:
        if self._running is None or self._running.is_over:
            self._running = RunningContainer(self.engine, self.digest, self.start_s, self.variables)
            self._description = self._description or self._running.device
        if self._running.device != self._description:
            raise DeviceError("start: the description differs from that at the first start")
        return self._running


def make(image: str) -> ContainerDevice:
    """Return the device of ``image``.

    Raises InputError, in one line, for what is no name of an image, without podman or docker, and
    for an image that is not on this machine.
    """
    try:
        check_image(image)
        check_folder()
        engine, digest = find_engine(image)
        engine.remove_abandoned()
    except InputError as error:
        raise InputError(f"device container:{readable(image, 80)}: {error}") from error
    return ContainerDevice(image, digest, engine)


CONTAINER = DeviceKind("container", "IMAGE", make)
