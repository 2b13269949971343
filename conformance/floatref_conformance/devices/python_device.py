"""Devices that are Python objects of a vendor, each in its own process."""

import sys
from pathlib import Path

from floatref.errors import InputError
from floatref_conformance.devices import process
from floatref_conformance.devices.executable import ExecDevice
from floatref_conformance.devices.host import FIND
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.devices.protocol import START_S, parse_line
from floatref_conformance.errors import DeviceError

HOST = (sys.executable, "-m", "floatref_conformance.devices.host")


def make(spec: str) -> ExecDevice:
    """Return the device that the factory ``spec``, as `package.module:factory`, makes.

    Raises InputError if the module or factory does not exist. The vendor's code runs only in the
    device's process, and the factory is not called yet.
    """
    module, _, factory = spec.partition(":")
    if not all(word.isidentifier() for word in (*module.split("."), *factory.split("."))):
        raise InputError(f"device python:{spec}: not of the form package.module:factory")
    missing = _missing(spec)
    if missing is not None:
        raise InputError(f"device python:{spec}: {missing}; check the name, or install it")
    return ExecDevice((*HOST, spec), Path.cwd())


def _missing(spec: str) -> str | None:
    """Return why the factory does not exist; None if it exists or this is not known yet."""
    try:
        child = process.start((*HOST, spec, FIND), Path.cwd())
    except DeviceError as error:
        raise InputError(f"device python:{spec}: {error}") from error
    try:
        missing = parse_line(child.receive(START_S)).get("missing")
    except DeviceError:
        return None
    finally:
        child.kill()
    return None if missing is None else process.readable(str(missing))


PYTHON = DeviceKind("python", "package.module:factory", make)
