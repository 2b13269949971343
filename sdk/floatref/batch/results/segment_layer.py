"""The rows of a summary as a layer of a GIS: a line for each segment of each wheel path."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from floatref.batch.results.record import Record, Row
from floatref.batch.results.summary import figures_of, measure_columns
from floatref.files.gis.layer import Columns, Feature, LayerCount, write_layer

FIGURES: Mapping[str, type] = {
    field.name: field.type
    for field in fields(Row)
    if field.name not in ("latitude_deg", "longitude_deg") and field.type in (str, int, float)
}
"""Columns of a row that are properties; where the segment is, its line says."""


def layer_columns(measures: bool) -> Columns:
    """Return names and types of the properties; with ``measures`` those of ride too.

    ``marked`` says that not all of the segment is valid; ``name`` is that of the recording.
    """
    return {"name": str, "marked": bool, **FIGURES, **measure_columns(measures)}


def features_of(name: str, rows: Iterable[Row]) -> Iterator[Feature]:
    """Yield the feature of every row of the recording called ``name``."""
    for row in rows:
        figures: dict[str, Any] = {"name": name, "marked": row.counted_share < 1.0}
        yield row.lines_deg, figures | figures_of(row)


def write_segment_layer(
    records: Iterable[Record], measures: bool, path: Path, overwrite: bool = False
) -> LayerCount:
    """Write the segments of ``records`` that have a place to ``path``, and count them.

    The suffix is .geojson or .gpkg. Raises InputError as `write_layer`.
    """
    features = (feature for record in records for feature in features_of(record.name, record.rows))
    return write_layer(features, layer_columns(measures), path, overwrite)
