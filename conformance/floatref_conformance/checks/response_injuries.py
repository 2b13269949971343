"""What happens in the field to the sensors of a vehicle's response, at the first wheel path."""

from collections.abc import Mapping
from types import MappingProxyType

from floatref_conformance.checks.spoiling import Injury, dropout, saturation, stuck

WHEEL, BODY = "unsprung_specific_force", "sprung_specific_force"
DEFLECTION = "suspension_deflection"

RESPONSE: Mapping[str, Injury] = MappingProxyType(
    {
        "response-wheel-dropout": dropout(WHEEL),
        "response-wheel-stuck": stuck(WHEEL),
        "response-wheel-saturation": saturation(WHEEL),
        "response-body-dropout": dropout(BODY),
        "response-deflection-dropout": dropout(DEFLECTION),
        "response-deflection-stuck": stuck(DEFLECTION),
    }
)
"""Injuries of sensors that a device has by the capability `response`."""
