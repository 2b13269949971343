"""A layer of a GIS: features with lines and properties, written as the suffix of its file says."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_file
from floatref.files.gis.geojson import write_geojson
from floatref.files.gis.geopackage import check_pyogrio, write_geopackage
from floatref.files.gis.lines import Line
from floatref.files.sources import name_errors

Columns = Mapping[str, type]
"""Names of the properties and their types: str, int, float or bool."""
Feature = tuple[tuple[Line, ...], Mapping[str, Any]]
"""Lines, and properties by name, of which NaN and None are unknown."""
WRITERS: Mapping[str, Callable[[Iterable[Feature], Columns, Path], None]] = {
    ".geojson": write_geojson,
    ".gpkg": write_geopackage,
}


@dataclass
class LayerCount:
    """How many features a layer has, and how many were left out because they have no place."""

    written: int = 0
    left_out: int = 0

    def __str__(self) -> str:
        """Return both in a few words."""
        without = f"; {self.left_out} without a place are left out" if self.left_out else ""
        return f"{self.written} segments{without}"


def check_layer(path: Path, overwrite: bool = False, in_new_folder: bool = False) -> None:
    """Raise InputError now for a layer that could not be written later.

    With ``in_new_folder`` the folder of ``path`` need not exist yet.
    """
    if path.suffix.lower() not in WRITERS:
        known = " or ".join(WRITERS)
        raise InputError(f"{path}: suffix {path.suffix!r} is no format of a layer; use {known}")
    if path.suffix.lower() == ".gpkg":
        with name_errors(path):
            check_pyogrio()
    if not in_new_folder:
        check_target(path, overwrite)


def write_layer(
    features: Iterable[Feature], columns: Columns, path: Path, overwrite: bool = False
) -> LayerCount:
    """Write ``features`` that have a line to ``path``, complete or not at all, and count them.

    Raises InputError as `check_layer`, and if ``path`` cannot be written.
    """
    check_layer(path, overwrite)
    count = LayerCount()
    with replace_file(path, overwrite) as beside:
        WRITERS[path.suffix.lower()](_placed(features, count), columns, beside)
    return count


def _placed(features: Iterable[Feature], count: LayerCount) -> Iterator[Feature]:
    for lines, properties in features:
        if lines:
            count.written += 1
            yield lines, properties
        else:
            count.left_out += 1
