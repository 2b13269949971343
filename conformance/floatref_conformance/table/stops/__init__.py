"""Drawn stops: every vehicle on three roads, every pipeline against the truth.

`make_stop_table` draws the drives, simulates them one by one, has every pipeline process each,
and compares the profiles around the stop with the elevation along the laser's path.
"""

from floatref_conformance.table.stops.stop_scores import StopScores
from floatref_conformance.table.stops.stop_settings import StopSettings
from floatref_conformance.table.stops.stop_table import (
    StopSummary,
    StopTable,
    WheelPath,
    make_stop_table,
    summary,
)

__all__ = [
    "StopScores",
    "StopSettings",
    "StopSummary",
    "StopTable",
    "WheelPath",
    "make_stop_table",
    "summary",
]
