"""The list of faults: what each does is fixed here, before any screening is written."""

from collections.abc import Mapping
from types import MappingProxyType

from floatref.errors import InputError
from floatref.values.display.similar_names import did_you_mean
from floatref_conformance.faults.listed import ListedFault
from floatref_conformance.faults.of_accelerometers import ACCELEROMETER_FAULTS
from floatref_conformance.faults.of_encoders import ENCODER_FAULTS
from floatref_conformance.faults.of_inertial_units import INERTIAL_FAULTS, SATELLITE_FAULTS
from floatref_conformance.faults.of_lasers import LASER_FAULTS
from floatref_conformance.faults.of_response import RESPONSE_FAULTS

FAULTS: Mapping[str, ListedFault] = MappingProxyType(
    {
        fault.name: fault
        for fault in (
            *ACCELEROMETER_FAULTS,
            *LASER_FAULTS,
            *ENCODER_FAULTS,
            *INERTIAL_FAULTS,
            *SATELLITE_FAULTS,
            *RESPONSE_FAULTS,
        )
    }
)
"""All faults by name, in the order of the list."""


def find_fault(name: str) -> ListedFault:
    """Return the fault called ``name``; InputError if the list has no such fault."""
    if name not in FAULTS:
        hint = did_you_mean(name, FAULTS) or "conformance faults --list names them"
        raise InputError(f"fault {name}: unknown; {hint}")
    return FAULTS[name]
