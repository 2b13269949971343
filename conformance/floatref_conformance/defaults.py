"""The suite's own devices and checks: a plug-in like any other."""

from collections.abc import Callable

from floatref_conformance.checks.bounce import BOUNCE
from floatref_conformance.checks.braking import BRAKING
from floatref_conformance.checks.coasting import COASTING
from floatref_conformance.checks.constant_speed import CONSTANT_SPEED
from floatref_conformance.checks.dead_start import DEAD_START
from floatref_conformance.checks.distance import DISTANCE
from floatref_conformance.checks.faults import FAULTS
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.invariance import INVARIANCE
from floatref_conformance.checks.low_speed import LOW_SPEED
from floatref_conformance.checks.near_stop import NEAR_STOP
from floatref_conformance.checks.quiescent import QUIESCENT
from floatref_conformance.checks.repeatability import REPEATABILITY
from floatref_conformance.checks.stop import STOP
from floatref_conformance.checks.throttle import THROTTLE
from floatref_conformance.checks.waveband import WAVEBAND
from floatref_conformance.devices.builtin import BUILTIN
from floatref_conformance.devices.executable import EXEC
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.devices.mutants import MUTANT
from floatref_conformance.devices.python_device import PYTHON
from floatref_conformance.devices.recorded import FILES
from floatref_conformance.hookspecs import hookimpl


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
    """Register the checks that are built, in the order of the suite's list."""
    register(QUIESCENT)
    register(BOUNCE)
    register(CONSTANT_SPEED)
    register(LOW_SPEED)
    register(COASTING)
    register(THROTTLE)
    register(BRAKING)
    register(NEAR_STOP)
    register(STOP)
    register(DEAD_START)
    register(WAVEBAND)
    register(REPEATABILITY)
    register(DISTANCE)
    register(INVARIANCE)
    register(FAULTS)
