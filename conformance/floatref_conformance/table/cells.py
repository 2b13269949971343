"""The finished table: one cell for each pipeline and run."""

from dataclasses import dataclass
from functools import cached_property

from floatref.errors import InputError
from floatref_conformance.table.published import PublishedFigures
from floatref_conformance.table.scores import Scores, mean_scores
from floatref_conformance.table.table_settings import TableSettings


@dataclass(frozen=True)
class Cell:
    """One pipeline on one run.

    Attributes:
        pipeline: its name.
        run: designation of the run.
        passes: the scores of every wheel path of every pass.
        published: the figures in print; None if not published.
    """

    pipeline: str
    run: str
    passes: tuple[Scores, ...]
    published: PublishedFigures | None = None

    @cached_property
    def mean(self) -> Scores:
        """The mean of each figure over the passes."""
        return mean_scores(self.passes)


@dataclass(frozen=True)
class ComparisonTable:
    """All cells, pipeline by pipeline, and the settings that made them."""

    settings: TableSettings
    cells: tuple[Cell, ...]

    def cell(self, pipeline: str, run: str) -> Cell:
        """Return the cell of ``pipeline`` and ``run``; InputError if it is missing."""
        for cell in self.cells:
            if (cell.pipeline, cell.run) == (pipeline, run):
                return cell
        raise InputError(f"pipeline {pipeline}, run {run}: not in this table; make it with both")

    def of_pipeline(self, pipeline: str) -> tuple[Cell, ...]:
        """Return the cells of ``pipeline`` in the order of print."""
        return tuple(cell for cell in self.cells if cell.pipeline == pipeline)
