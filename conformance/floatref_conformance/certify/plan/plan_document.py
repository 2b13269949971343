"""What is certified: sections with their runs, stationary tests, and the plan as a TOML file."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.schema import enforce_schema
from floatref.files.sources import name_errors
from floatref.files.toml_document import read_toml
from floatref.values.display.similar_names import did_you_mean
from floatref_conformance.certify.plan.run_paths import check_exists, runs_of
from floatref_conformance.schemas import read_schema

Stretch = tuple[float, float]
"""From and to, in m."""


@dataclass(frozen=True)
class SectionPlan:
    """One test section.

    Attributes:
        name: what it is called.
        reference: its reference profile, of any format.
        runs: repeated runs over it: profiles of any format, or recordings.
        stretch_m: from and to on the reference's axis; None: all of the reference.
    """

    name: str
    reference: Path
    runs: tuple[Path, ...]
    stretch_m: Stretch | None = None


@dataclass(frozen=True)
class StationaryPlan:
    """A recorded stationary test: a profile or a recording, and the part that counts, in m."""

    source: Path
    stretch_m: Stretch | None = None


@dataclass(frozen=True)
class DistancePlan:
    """A path of known length in m, and what the profiler read for it, run by run, in m."""

    known_m: float
    readings_m: tuple[float, ...]


@dataclass(frozen=True)
class Plan:
    """All that a worksheet is made of."""

    sections: tuple[SectionPlan, ...]
    profiler: str = ""
    quiescent: StationaryPlan | None = None
    bounce: StationaryPlan | None = None
    distance: DistancePlan | None = None


@dataclass(frozen=True)
class Processing:
    """How recordings become profiles: what the `floatref process` command is given.

    ``reference_is_run`` says that the references are runs of a profiler, and no truth.
    """

    pipeline: str | None = None
    settings: Path | None = None
    adapter: str | None = None
    channel_map: Path | None = None
    reference_is_run: bool = False


SCHEMA = "conformance-plan-1"
ALIKE = 0.8
"""From this likeness on, an unknown key is taken for a known one with a slip of the pen."""


def read_plan(path: Path) -> Plan:
    """Return the plan in the TOML file ``path``; its paths are relative to it.

    Unknown keys are ignored, unless they look like a known one. Raises InputError with one line
    naming the file, the entry and the value for anything else than a plan, two sections of one
    name, and a path at which there is nothing.
    """
    path = Path(path)
    document = read_toml(path, "plan")
    schema = read_schema(SCHEMA)
    with name_errors(path):
        for place, table, known in _tables(document, schema):
            _check_keys(place, table, known)
    enforce_schema(document, schema, path)
    with name_errors(path):
        return _plan(document, path.parent)


def _plan(document: Mapping[str, Any], folder: Path) -> Plan:
    sections = tuple(_section(entry, folder) for entry in document["sections"])
    names = [section.name for section in sections]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"two sections are called {name}; give each a name of its own")
    distance = document.get("distance")
    return Plan(
        sections,
        document.get("profiler", ""),
        _stationary(document, "quiescent", folder),
        _stationary(document, "bounce", folder),
        distance and DistancePlan(float(distance["known_m"]), _floats(distance["readings_m"])),
    )


def _section(entry: Mapping[str, Any], folder: Path) -> SectionPlan:
    with name_errors(f"section {entry['name']}"):
        return SectionPlan(
            entry["name"],
            check_exists(entry["reference"], folder),
            runs_of(entry["runs"], folder),
            _stretch(entry),
        )


def _stationary(document: Mapping[str, Any], name: str, folder: Path) -> StationaryPlan | None:
    if name not in document:
        return None
    with name_errors(name):
        return StationaryPlan(
            check_exists(document[name]["source"], folder), _stretch(document[name])
        )


def _stretch(entry: Mapping[str, Any]) -> Stretch | None:
    ends = [name for name in ("from_m", "to_m") if name in entry]
    if len(ends) == 1:
        raise InputError(f"{ends[0]} stands alone; give both from_m and to_m, or neither")
    return stretch_of(entry["from_m"], entry["to_m"]) if ends else None


def stretch_of(start_m: float, end_m: float) -> Stretch:
    """Return a stretch; InputError unless it ends behind its start."""
    if not start_m < end_m:
        raise InputError(f"from {start_m:g} to {end_m:g} m is no stretch; it has to end farther on")
    return float(start_m), float(end_m)


def _floats(values: list[float]) -> tuple[float, ...]:
    return tuple(map(float, values))


def _tables(document: Any, schema: Any) -> Iterator[tuple[str, Any, list[str]]]:
    """Yield every table of a plan with its place and the keys that it may have."""
    parts = schema["properties"]
    yield "", document, list(parts)
    for name in ("quiescent", "bounce"):
        yield name, document.get(name), list(schema["$defs"]["stationary"]["properties"])
    yield "distance", document.get("distance"), list(parts["distance"]["properties"])
    sections = document.get("sections")
    for index, entry in enumerate(sections if isinstance(sections, list) else ()):
        yield f"sections[{index}]", entry, list(parts["sections"]["items"]["properties"])


def _check_keys(place: str, table: Any, known: list[str]) -> None:
    """Raise InputError for a key that was meant to be a known one."""
    for key in table if isinstance(table, dict) else ():
        hint = "" if key in known else did_you_mean(key, known, ALIKE)
        if hint:
            raise InputError(f"{place}{'.' if place else ''}{key}: {hint}")
