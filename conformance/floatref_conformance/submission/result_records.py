"""The result of a case as JSON, and back: all that decides, without profiles and evidence."""

from collections.abc import Mapping
from math import inf, isfinite, nan
from typing import Any

from floatref.errors import InputError
from floatref_conformance.checks.nees import PathNees
from floatref_conformance.checks.verdict import CaseResult, Measurement
from floatref_conformance.classes import DeviceClass

BEYOND = {"nan": nan, "inf": inf, "-inf": -inf}
"""Numbers that JSON does not have, by their texts."""


def write_result(result: CaseResult) -> dict[str, Any]:
    """Return ``result`` as an object of JSON; every float comes back bit for bit."""
    return {
        "name": result.name,
        "parameters": dict(result.parameters),
        "measurements": [_write_measurement(m) for m in result.measurements],
        "fault": result.fault,
        "hung": result.hung,
        "skipped": result.skipped,
        "flagged_m": _number(result.flagged_m),
        "early_m": _number(result.early_m),
        "false_alarms": result.false_alarms,
        "nees": [[n.track, _number(n.mean), n.points] for n in result.nees],
    }


def read_result(found: Any, where: str) -> CaseResult:
    """Return the result in ``found``; InputError naming ``where`` if it holds no result."""
    try:
        return CaseResult(
            str(found["name"]),
            {part: dict(found["parameters"][part]) for part in ("scenario", "variation")},
            tuple(_read_measurement(m) for m in found["measurements"]),
            _text(found["fault"]),
            bool(found["hung"]),
            _text(found["skipped"]),
            _float(found["flagged_m"]),
            _float(found["early_m"]),
            false_alarms=int(found["false_alarms"]),
            nees=tuple(PathNees(str(t), _float(mean), int(n)) for t, mean, n in found["nees"]),
        )
    except (AttributeError, KeyError, TypeError, ValueError, OverflowError) as error:
        text = " ".join(f"{type(error).__name__}: {error}".split())
        raise InputError(f"{where}: not the result of a case ({text}); ask for it again") from error


def _write_measurement(measured: Measurement) -> dict[str, Any]:
    return {
        "quantity": measured.quantity,
        "track": measured.track,
        "value": _number(measured.value),
        "unit": measured.unit,
        "limits": {c.value: _number(limit) for c, limit in measured.limits.items()},
        "is_flagged_length": measured.is_flagged_length,
    }


def _read_measurement(found: Mapping[str, Any]) -> Measurement:
    return Measurement(
        str(found["quantity"]),
        str(found["track"]),
        _float(found["value"]),
        str(found["unit"]),
        {DeviceClass(name): _limit(limit) for name, limit in found["limits"].items()},
        is_flagged_length=bool(found["is_flagged_length"]),
    )


def _number(value: float) -> float | str:
    return float(value) if isfinite(value) else str(float(value))


def _float(found: Any) -> float:
    """Return a number of JSON, or one that JSON does not have; ValueError for others."""
    if isinstance(found, str):
        return BEYOND[found]
    return float(found)


def _limit(found: Any) -> float:
    """Return a limit; ValueError for one that nothing can be divided by."""
    limit = _float(found)
    if not limit > 0.0:
        raise ValueError(f"a limit of {limit}")
    return limit


def _text(found: Any) -> str | None:
    return None if found is None else str(found)
