"""What `report.html` says of what a check asks."""

from dataclasses import dataclass

from floatref.errors import InputError
from floatref_conformance.checks.interface import Check
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.judging import scored_by
from floatref_conformance.render.drawing import drawing_svg
from floatref_conformance.render.failures import Markup


@dataclass(frozen=True)
class Asked:
    """One check; ``limits`` has a row for each quantity, with a limit for each class."""

    anchor: str
    id: str
    title: str
    clause: str
    derivation: str
    floor: str
    limits: tuple[tuple[str, tuple[str, ...]], ...]
    drawing: Markup | None


def asked(check: Check, anchor: str) -> Asked:
    """Return what is said of ``check``, with the drawing of its first case."""
    return Asked(
        anchor=anchor,
        id=check.id,
        title=check.title,
        clause=check.clause,
        derivation=check.derivation,
        floor=check.floor,
        limits=tuple(
            (quantity, tuple(str(limits.get(c, "none")) for c in DeviceClass))
            for quantity, limits in check.limits.items()
        ),
        drawing=_drawing(check, anchor),
    )


def _drawing(check: Check, anchor: str) -> Markup | None:
    """Return the drawing; None for a check without cases, or whose first makes no drive."""
    cases = check.cases(0, Effort.QUICK)
    if not cases:
        return None
    scored_m = scored_by(check, cases[0])
    try:
        return Markup(drawing_svg(cases[0].scenario, f"{anchor}-drawing", scored_m))
    except InputError:
        return None
