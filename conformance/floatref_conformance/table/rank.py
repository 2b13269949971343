"""How well the order of our cross correlations follows the published one."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.table.cells import Cell, ComparisonTable
from floatref_conformance.table.passes import FITTED
from floatref_conformance.table.published import PRINTED_FLOOR

CHAPTER = 5
"""The chapter whose cells are ranked."""


@dataclass(frozen=True)
class RankCorrelation:
    """Spearman's rank correlation with the published cross correlations.

    Attributes:
        ours: of our means, clipped below at 0.2 as in print.
        rule: of the rule that a stop scores low and every other run high, which knows nothing.
        cells: how many cells were ranked.

    A value is None where one side is the same in all cells, or there are fewer than two.
    """

    ours: float | None
    rule: float | None
    cells: int


def rank_correlations(table: ComparisonTable) -> dict[str, RankCorrelation]:
    """Return the rank correlation over the ``chapter_5`` cells, those ``predicted``, and ``stops``.

    Predicted are all of chapter 5 but the `FITTED` ones.
    """
    predicted = [cell for cell in table.cells if (cell.pipeline, cell.run) not in FITTED]
    return {
        "chapter_5": rank_correlation(table.cells),
        "predicted": rank_correlation(predicted),
        "stops": rank_correlation(cell for cell in table.cells if _is_stop(cell)),
    }


def rank_correlation(cells: Iterable[Cell]) -> RankCorrelation:
    """Return the rank correlation over those ``cells`` that chapter 5 has in print."""
    pairs = [
        (cell, cell.published.scores.cross_correlation)
        for cell in cells
        if cell.published is not None and cell.published.chapter == CHAPTER
    ]
    ours = [max(cell.mean.cross_correlation, PRINTED_FLOOR) for cell, _ in pairs]
    rule = [0.0 if _is_stop(cell) else 1.0 for cell, _ in pairs]
    published = [value for _, value in pairs]
    return RankCorrelation(_spearman(ours, published), _spearman(rule, published), len(pairs))


def _is_stop(cell: Cell) -> bool:
    return RUNS[cell.run].kind == "stop"


def _spearman(x: Sequence[float], y: Sequence[float]) -> float | None:
    """Return Spearman's rank correlation, equal values sharing their mean rank."""
    if len(set(x)) < 2 or len(set(y)) < 2:
        return None
    from scipy.stats import spearmanr

    value = float(spearmanr(x, y).statistic)
    return value if math.isfinite(value) else None
