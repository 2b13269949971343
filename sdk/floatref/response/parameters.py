"""Checks of a model's parameters: every message names the parameter, its value and its unit."""

from collections.abc import Collection, Mapping
from math import isfinite

from floatref.errors import InputError

UNITS = {
    "_n_per_m": "N/m",
    "_ns_per_m": "N·s/m",
    "_kg_m2": "kg·m²",
    "_kg": "kg",
    "_m": "m",
}
"""Units by the end of a parameter's name, the longer first."""


def unit_of(parameter: str) -> str:
    """Return the unit that the name of ``parameter`` ends with."""
    return next(unit for end, unit in UNITS.items() if parameter.endswith(end))


def check_parameters(
    model: str,
    values: Mapping[str, float],
    not_below_zero: Collection[str] = (),
    any_sign: Collection[str] = (),
) -> None:
    """Raise InputError unless ``values`` are finite and above zero, but for those named."""
    for name, value in values.items():
        if name in any_sign:
            right, wanted = True, "a finite number"
        elif name in not_below_zero:
            right, wanted = value >= 0, "a finite number, zero or above"
        else:
            right, wanted = value > 0, "a finite number above zero"
        if not (right and isfinite(value)):
            raise InputError(
                f"model {model}: {name} is {value:g} {unit_of(name)}; give it in "
                f"{unit_of(name)}, {wanted}"
            )


def check_inertia(model: str, name: str, inertia: float, mass: float, reach_m: float) -> None:
    """Raise InputError if a body of ``mass`` in kg cannot have ``inertia`` in kg·m².

    Were all of it as far as ``reach_m``, in m, from its centre, it would be mass·reach².
    """
    most = mass * reach_m**2
    if inertia > most:
        raise InputError(
            f"model {model}: {name} is {inertia:g} kg·m², above the {most:g} kg·m² of {mass:g} kg "
            f"at {reach_m:g} m from the centre; check its unit and those of mass and distances"
        )
