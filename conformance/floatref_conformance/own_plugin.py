"""The suite's own devices and checks, registered like those of any other plug-in."""

from collections.abc import Callable

from floatref_conformance.checks.distance.feature_places import DISTANCE
from floatref_conformance.checks.distance.waveband import WAVEBAND
from floatref_conformance.checks.driving.check import DRIVING_CHECKS
from floatref_conformance.checks.faults.check import FAULTS
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.sameness.invariance import INVARIANCE
from floatref_conformance.checks.sameness.repeatability import REPEATABILITY
from floatref_conformance.checks.stationary.parked_checks import BOUNCE, QUIESCENT
from floatref_conformance.devices.builtin import BUILTIN
from floatref_conformance.devices.executable import EXEC
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.devices.python_device import PYTHON
from floatref_conformance.devices.recorded import FILES
from floatref_conformance.hookspecs import hookimpl
from floatref_conformance.mutants.device import MUTANT


@hookimpl
def conformance_register_devices(register: Callable[[DeviceKind], None]) -> None:
    """Register the suite's own kinds of devices."""
    register(BUILTIN)
    register(PYTHON)
    register(EXEC)
    register(FILES)
    register(MUTANT)


@hookimpl
def conformance_register_checks(register: Callable[[Check], None]) -> None:
    """Register the implemented checks, in the order of the suite's list."""
    register(QUIESCENT)
    register(BOUNCE)
    for check in DRIVING_CHECKS.values():
        register(check)
    register(WAVEBAND)
    register(REPEATABILITY)
    register(DISTANCE)
    register(INVARIANCE)
    register(FAULTS)
