"""The table as one JSON object, ``conformance-table/1``."""

from dataclasses import asdict
from typing import Any

from floatref_conformance.render.json_values import finite
from floatref_conformance.schemas import enforce
from floatref_conformance.table.cells import Cell, ComparisonTable
from floatref_conformance.table.passes import FITTED, ROADS, SLIP_PERCENT_PER_G, slip_of
from floatref_conformance.table.published import REFERENCE_IRI_M_PER_KM, published_table
from floatref_conformance.table.rank import rank_correlations

FORMAT = "conformance-table/1"
BESIDE = "cross_correlation_encoder"
"""The figure that print does not have."""


def document(table: ComparisonTable) -> dict[str, Any]:
    """Return the JSON object of ``table``; SuiteError if it breaks its own schema."""
    settings = table.settings
    made = {
        "format": FORMAT,
        "seed": settings.seed,
        "seeds": settings.seeds,
        "roads": settings.roads,
        "road": {"kinds": list(ROADS), "iri_m_per_km": REFERENCE_IRI_M_PER_KM},
        "vehicle": settings.vehicle,
        "slip_percent_per_g": SLIP_PERCENT_PER_G,
        "cells": [_cell(cell) for cell in table.cells],
        "rank_correlation": {
            name: asdict(value) for name, value in rank_correlations(table).items()
        },
    }
    enforce("conformance-table-1", made)
    return made


def _cell(cell: Cell) -> dict[str, Any]:
    """Return our means and the published figures; null if not published."""
    published = cell.published
    named: dict[str, Any] = {
        "pipeline": cell.pipeline,
        "table": published_table(cell.pipeline),
        "run": cell.run,
        "passes": len(cell.passes),
    }
    for name, value in finite(asdict(cell.mean)).items():
        named[name] = value
        if name != BESIDE:
            named[f"published_{name}"] = published and getattr(published.scores, name)
    named["slip_percent_per_g"] = slip_of(cell.pipeline)
    named["fitted"] = (cell.pipeline, cell.run) in FITTED
    bounded = published and published.cross_correlation_is_upper_bound
    return named | {"published_cross_correlation_is_upper_bound": bounded}
