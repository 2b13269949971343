"""Layers as GeoJSON (RFC 7946): WGS 84, longitude before latitude, no member crs."""

import json
from collections.abc import Iterable, Mapping
from math import isfinite
from pathlib import Path
from typing import Any

from floatref.files.gis.lines import Line


def write_geojson(
    features: Iterable[tuple[tuple[Line, ...], Mapping[str, Any]]],
    columns: Mapping[str, type],
    path: Path,
) -> None:
    """Write ``features`` to ``path``, a line of text each, in bounded memory.

    ``columns`` are the names of the properties in their order; one that is unknown is null.
    """
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write('{"type": "FeatureCollection", "features": [')
        for number, (lines, properties) in enumerate(features):
            stream.write(",\n" if number else "\n")
            stream.write(_feature(lines, {name: properties.get(name) for name in columns}))
        stream.write("\n]}\n")


def _feature(lines: tuple[Line, ...], properties: Mapping[str, Any]) -> str:
    one = len(lines) == 1
    geometry = {
        "type": "LineString" if one else "MultiLineString",
        "coordinates": lines[0] if one else lines,
    }
    known = {name: _plain(value) for name, value in properties.items()}
    feature = {"type": "Feature", "geometry": geometry, "properties": known}
    return json.dumps(feature, ensure_ascii=False, allow_nan=False)


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not isfinite(value) else value
