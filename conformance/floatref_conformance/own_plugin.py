"""The suite's own devices and checks, registered like those of any other plug-in."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from floatref_conformance.checks.distance.feature_places import DistanceCheck
from floatref_conformance.checks.distance.waveband import WavebandCheck
from floatref_conformance.checks.driving.check import driving_checks
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.sameness.invariance import InvarianceCheck
from floatref_conformance.checks.sameness.repeatability import RepeatabilityCheck
from floatref_conformance.checks.stationary.parked_checks import BOUNCE, QUIESCENT
from floatref_conformance.devices.builtin import BUILTIN
from floatref_conformance.devices.containers.container_device import CONTAINER
from floatref_conformance.devices.executable import EXEC
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.devices.python_device import PYTHON
from floatref_conformance.devices.recorded import FILES
from floatref_conformance.editions.edition import Edition
from floatref_conformance.hookspecs import hookimpl
from floatref_conformance.mutants.device import MUTANT


def make_checks(edition: Edition) -> tuple[Check, ...]:
    """Return the suite's checks as ``edition`` has them, in the order of its list."""
    return (
        replace(QUIESCENT, edition=edition),
        replace(BOUNCE, edition=edition),
        *driving_checks(edition).values(),
        WavebandCheck(edition=edition),
        RepeatabilityCheck(edition=edition),
        DistanceCheck(edition=edition),
        InvarianceCheck(edition=edition),
        FaultsCheck(edition=edition),
    )


@dataclass(frozen=True)
class OwnPlugin:
    """The plug-in of the suite itself, with the checks of one edition."""

    edition: Edition

    @hookimpl
    def conformance_register_devices(self, register: Callable[[DeviceKind], None]) -> None:
        """Register the suite's own kinds of devices."""
        register(BUILTIN)
        register(PYTHON)
        register(EXEC)
        register(CONTAINER)
        register(FILES)
        register(MUTANT)

    @hookimpl
    def conformance_register_checks(self, register: Callable[[Check], None]) -> None:
        """Register the implemented checks, in the order of the suite's list."""
        for check in make_checks(self.edition):
            register(check)
