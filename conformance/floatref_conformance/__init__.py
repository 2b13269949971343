"""The proving ground, the checks and the judge of inertial profiling software.

A check draws cases from a seed, has each simulated with its truth, gives the device under
test what a profiler's sensors would have recorded, and measures the profile that comes back.
Units and axes are those of `floatref`: SI, ISO 8855, IRI in m/km.
"""

from importlib import import_module

from floatref_conformance.editions import EDITION as EDITION
from floatref_conformance.editions import EDITIONS as EDITIONS

# As in typing, whose import takes as long as all of this: Ctrl-C in it would be a traceback.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from floatref_conformance.checks.interface import Check as Check
    from floatref_conformance.devices.interface import DeviceKind as DeviceKind
    from floatref_conformance.hookspecs import hookimpl as hookimpl
    from floatref_conformance.table import TableSettings as TableSettings
    from floatref_conformance.table import make_table as make_table

# Imported on first use: a module that wants the edition alone loads no check.
_PUBLIC = {
    "Check": "checks.interface",
    "DeviceKind": "devices.interface",
    "TableSettings": "table",
    "hookimpl": "hookspecs",
    "make_table": "table",
}
__all__ = ["EDITION", "EDITIONS", *_PUBLIC]


def __getattr__(name: str) -> "Any":
    """Import the public name ``name``."""
    if name not in _PUBLIC:
        raise AttributeError(f"module floatref_conformance has no attribute {name!r}")
    return getattr(import_module(f"floatref_conformance.{_PUBLIC[name]}"), name)


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)
