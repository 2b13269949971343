"""The hooks of a plug-in, found in the entry-point group `floatref_conformance`.

A hook registers devices or checks. It is called once per command, plug-in by plug-in. The suite
registers its own devices and checks by such a plug-in too.
"""

from collections.abc import Callable

import pluggy

from floatref_conformance.checks.interface import Check
from floatref_conformance.devices.interface import DeviceKind

GROUP = "floatref_conformance"
"""Name of the entry-point group and of the pluggy project."""

hookspec = pluggy.HookspecMarker(GROUP)
hookimpl = pluggy.HookimplMarker(GROUP)


@hookspec
def conformance_register_devices(register: Callable[[DeviceKind], None]) -> None:
    """Call ``register`` with each kind of device; its prefix must be new."""


@hookspec
def conformance_register_checks(register: Callable[[Check], None]) -> None:
    """Call ``register`` with each check, in the order in which they run; its id must be new."""
