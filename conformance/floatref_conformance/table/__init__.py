"""The published tables beside ours: 17 runs, every pipeline, three figures for each.

`make_table` simulates the runs on several roads with several sensor errors each, has every
pipeline process them, and scores the profiles as chapters 5 and 6 of Karamihas 2021 do.
"""

from floatref_conformance.table.cells import Cell, ComparisonTable
from floatref_conformance.table.making import make_table
from floatref_conformance.table.published import PublishedFigures, published_figures
from floatref_conformance.table.rank import RankCorrelation, rank_correlation, rank_correlations
from floatref_conformance.table.scores import Scores, mean_scores, score
from floatref_conformance.table.table_settings import TableSettings

__all__ = [
    "Cell",
    "ComparisonTable",
    "PublishedFigures",
    "RankCorrelation",
    "Scores",
    "TableSettings",
    "make_table",
    "mean_scores",
    "published_figures",
    "rank_correlation",
    "rank_correlations",
    "score",
]
