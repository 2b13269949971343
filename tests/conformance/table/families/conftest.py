"""Tables of families made by hand."""

import pytest

from floatref_conformance.table.families import (
    FamilyScores,
    FamilySettings,
    FamilyTable,
    PathScores,
)
from floatref_conformance.table.families.family_table import FamilyPath


def path_scores(
    correlation=0.99, error=1.0, right=True, wrong_by=1.0, share=95.0, all_right=True, points=1000
):
    return PathScores(correlation, error, share, right, wrong_by, all_right, points)


@pytest.fixture
def hand_families():
    """Return a function that makes a table; ``scores`` has two axes, or None, by condition."""

    def make(scores, pipelines=("temporal-basic",), family="urban"):
        settings = FamilySettings(family, drives=1, pipelines=pipelines)
        table = FamilyTable(settings)
        for condition, _, scenario in settings.scenarios(frozenset()):
            for pipeline in pipelines:
                axes = scores.get(condition.name, (path_scores(), path_scores()))
                found = None if axes is None else FamilyScores(*axes, 3.0, 0.0, 0.0)
                failure = "no profile" if axes is None else ""
                table.paths.append(
                    FamilyPath(pipeline, condition, "left", scenario, found, failure)
                )
        return table

    return make


@pytest.fixture
def axis():
    """Return the function that makes the scores of one axis."""
    return path_scores
