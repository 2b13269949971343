"""The published figures are those of the dissertation's tables."""

from collections import Counter

import pytest

from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.table import Scores, published_figures
from floatref_conformance.table.published import RUN_NAMES, published_table

COUNTS = {
    **dict.fromkeys(("5.3", "5.4", "5.5", "5.7", "5.8", "5.9", "5.10"), 17),
    "5.6": 10,
    "5.11": 8,
    "5.12": 10,
    "6.4": 7,
    **dict.fromkeys(("6.2", "6.3", "6.5", "6.6"), 17),
}


def test_every_table_is_whole_and_names_known_runs():
    figures = published_figures()
    assert Counter(f.table for f in figures.values()) == COUNTS
    assert {run for _, run in figures} == set(RUN_NAMES) == set(RUNS) - {"ref_72"}
    assert len(RUN_NAMES) == 17


@pytest.mark.parametrize(
    ("pipeline", "run", "table", "scores", "bounded"),
    [
        # The text of section 5.3 and of the conclusions repeats some figures of its tables.
        ("temporal-basic", "sg_10.7s_0.20g", "5.3", Scores(3299.8, 13139.7, 0.2), True),
        ("temporal-basic", "brk_71-30_0.19g", "5.3", Scores(3.4, 10.5, 0.836), False),
        ("spatial-basic", "sg_10.7s_0.20g", "5.9", Scores(2141.0, 8607.7, 0.2), True),
    ],
)
def test_single_figures(pipeline, run, table, scores, bounded):
    found = published_figures()[pipeline, run]
    assert (found.table, found.scores) == (table, scores)
    assert found.cross_correlation_is_upper_bound is bounded
    assert found.chapter == 5
    assert published_table(pipeline) == table


def test_upper_bounds_are_the_smallest_correlation_in_print():
    for found in published_figures().values():
        assert 0.2 <= found.scores.cross_correlation <= 1.0
        if found.cross_correlation_is_upper_bound:
            assert found.scores.cross_correlation == 0.2


def test_what_was_not_published_has_no_table():
    assert published_table("temporal-matched-hpf") is None
