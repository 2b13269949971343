"""Tables made by hand, so that what is made of them is tested apart from any simulation."""

from collections.abc import Callable, Mapping

import pytest

from floatref_conformance.table import Cell, ComparisonTable, Scores, TableSettings
from floatref_conformance.table.published import published_figures

Figures = Mapping[tuple[str, str], Scores]


@pytest.fixture
def hand_table() -> Callable[..., ComparisonTable]:
    """Return a function that makes a table of scores by pipeline and run, one pass each."""

    def make(scores: Figures, settings: TableSettings | None = None) -> ComparisonTable:
        figures = published_figures()
        cells = tuple(Cell(*key, (value,), figures.get(key)) for key, value in scores.items())
        return ComparisonTable(settings or TableSettings(), cells)

    return make


@pytest.fixture
def small() -> TableSettings:
    """Settings of one pipeline in print and two runs: a stop and a brake."""
    return TableSettings(
        roads=1, seeds=1, runs=("sg_5.7s_0.20g", "brk_49-20_0.25g"), pipelines=("temporal-basic",)
    )
