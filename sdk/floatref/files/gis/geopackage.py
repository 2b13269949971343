"""Layers as GeoPackage, through GDAL (pyogrio): lines in WGS 84, a column for each property."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError, missing_extra
from floatref.files.gis.lines import Line

LAYER = "segments"
"""Name of the layer in the file."""
TOGETHER = 4096
"""Features in memory at a time."""
TYPES: Mapping[type, Any] = {str: object, int: np.int64, float: np.float64, bool: np.bool_}

Features = Sequence[tuple[tuple[Line, ...], Mapping[str, Any]]]


def check_pyogrio() -> None:
    """Raise InputError if pyogrio or shapely is missing."""
    _libraries()


def write_geopackage(
    features: Iterable[tuple[tuple[Line, ...], Mapping[str, Any]]],
    columns: Mapping[str, type],
    path: Path,
) -> None:
    """Write ``features`` to ``path``; ``columns`` are names and types of the properties.

    A layer without features has its columns all the same. Raises InputError if a library is
    missing, or if GDAL cannot write the file.
    """
    pyogrio, shapely = _libraries()
    waiting = iter(features)
    append = False
    while (batch := list(islice(waiting, TOGETHER))) or not append:
        try:
            _write(batch, columns, path, append, pyogrio, shapely)
        except (pyogrio.errors.DataSourceError, pyogrio.errors.DataLayerError) as error:
            reason = f"cannot be written ({' '.join(str(error).split())[:160]})"
            raise InputError(f"{path}: {reason}; choose another place") from error
        append = True


def _write(
    batch: Features,
    columns: Mapping[str, type],
    path: Path,
    append: bool,
    pyogrio: Any,
    shapely: Any,
) -> None:
    shapes = [shapely.MultiLineString(lines) for lines, _ in batch]
    pyogrio.raw.write(
        path,
        np.array(shapely.to_wkb(shapes), dtype=object) if shapes else np.empty(0, dtype=object),
        [_column(batch, name, kind) for name, kind in columns.items()],
        np.array(list(columns)),
        layer=LAYER,
        driver="GPKG",
        geometry_type="MultiLineString",
        crs="EPSG:4326",
        append=append,
    )


def _column(batch: Features, name: str, kind: type) -> NDArray[Any]:
    values = [properties.get(name) for _, properties in batch]
    if kind is float:
        values = [np.nan if value is None else value for value in values]
    return np.array(values, dtype=TYPES[kind])


def _libraries() -> tuple[Any, Any]:
    try:
        import pyogrio
        import shapely
    except ImportError as error:
        missing = error.name or "pyogrio"
        raise missing_extra(f"a GeoPackage needs {missing}", "gis") from error
    return pyogrio, shapely
