"""Rank correlation with print: by hand, with ties, and of the rule that knows nothing."""

import pytest
from scipy.stats import spearmanr

from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.table import Scores, published_figures, rank_correlation
from floatref_conformance.table.rank import rank_correlations

MEAN_REMOVAL = "temporal-mean-removal"
# In print 0.954, 0.848, 0.930, 0.942, 0.985: ranks 4, 1, 2, 3, 5.
RUNS_BY_HAND = (
    "brk_71-30_0.19g", "brk_72-29_0.39g", "brk_49-22_0.16g", "brk_49-20_0.25g", "const_16",
)  # fmt: skip


def correlating(hand_table, values):
    return hand_table({key: Scores(2.0, 0.0, value) for key, value in values.items()})


def test_five_cells_by_hand(hand_table):
    ours = (0.6, 0.5, 0.9, 0.8, 0.99)  # ranks 2, 1, 4, 3, 5
    values = {(MEAN_REMOVAL, run): value for run, value in zip(RUNS_BY_HAND, ours, strict=True)}
    found = rank_correlation(correlating(hand_table, values).cells)
    squares = (4 - 2) ** 2 + (2 - 4) ** 2
    assert found.ours == pytest.approx(1 - 6 * squares / (5 * 24))
    assert found.cells == 5
    assert found.rule is None


def test_values_below_the_printed_floor_share_a_rank(hand_table):
    keys = [(MEAN_REMOVAL, run) for run in RUNS_BY_HAND]
    ours = (0.15, -0.7, 0.2, 0.8, 0.9)
    found = rank_correlation(correlating(hand_table, dict(zip(keys, ours, strict=True))).cells)
    published = [published_figures()[key].scores.cross_correlation for key in keys]
    assert found.ours == pytest.approx(spearmanr([0.2, 0.2, 0.2, 0.8, 0.9], published).statistic)
    assert found.ours != pytest.approx(spearmanr(ours, published).statistic)


def test_all_cells_of_chapter_5_against_themselves_and_by_the_rule(hand_table):
    values = {key: f.scores.cross_correlation for key, f in published_figures().items()}
    values["temporal-matched-hpf", "const_16"] = 0.0
    found = rank_correlations(correlating(hand_table, values))
    assert found["chapter_5"].ours == pytest.approx(1.0)
    assert round(found["chapter_5"].rule, 2) == 0.70
    assert found["chapter_5"].cells == 147
    stops = sum(RUNS[run].kind == "stop" and f.chapter == 5 for (_, run), f in
                published_figures().items())  # fmt: skip
    assert found["stops"].cells == stops == 70
    assert found["stops"].ours == pytest.approx(1.0)
    assert found["stops"].rule is None


def test_a_side_without_order_has_no_rank_correlation(hand_table):
    values = dict.fromkeys(((MEAN_REMOVAL, run) for run in RUNS_BY_HAND), 0.5)
    assert rank_correlation(correlating(hand_table, values).cells).ours is None
    assert rank_correlation(()).ours is None
