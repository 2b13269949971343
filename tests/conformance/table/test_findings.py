"""What the dissertation found, as laws of the averaged table, and how well the order agrees.

One set of passes on each of three roads, both wheel paths: every figure is a mean of six.
"""

import pytest

from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.table import (
    ComparisonTable,
    TableSettings,
    make_table,
    published_figures,
    rank_correlations,
)

pytestmark = [pytest.mark.slow, pytest.mark.nightly, pytest.mark.cites("Tables 5.3 to 5.12")]
STOPS = [name for name, run in RUNS.items() if run.kind == "stop"]
LONG_STOPS = [name for name in STOPS if (RUNS[name].dwell_s or 0.0) >= 5.0]
CHAPTER_5 = tuple(
    dict.fromkeys(
        pipeline
        for (pipeline, _), figures in published_figures().items()
        if figures.table.startswith("5.")
    )
)
ADAPTIVE = ("temporal-adaptive-hpf", "temporal-adaptive-hpf-spatial-backward")
REFLECTION = "spatial-hpf-timer-distortion-reflection"


@pytest.fixture(scope="module")
def table() -> ComparisonTable:
    return make_table(TableSettings(seed=0, roads=3, seeds=1, pipelines=CHAPTER_5))


def peak(table: ComparisonTable, pipeline: str, run: str) -> float:
    return table.cell(pipeline, run).mean.peak_m_per_km


def test_the_basic_algorithms_fail_at_every_stop(table: ComparisonTable) -> None:
    for run in STOPS:
        for pipeline in ("temporal-basic", "spatial-basic"):
            assert peak(table, pipeline, run) > 50.0, (pipeline, run)


def test_mean_removal_is_better_and_still_bad_at_long_stops(table: ComparisonTable) -> None:
    for run in STOPS:
        assert peak(table, "temporal-mean-removal", run) < peak(table, "temporal-basic", run), run
    for run in LONG_STOPS:
        assert peak(table, "temporal-mean-removal", run) > 20.0, run


def test_temporal_high_pass_is_below_mean_removal(table: ComparisonTable) -> None:
    for run in STOPS:
        assert peak(table, "temporal-hpf", run) < peak(table, "temporal-mean-removal", run), run


@pytest.mark.parametrize("pipeline", ADAPTIVE)
def test_adaptive_cut_off_is_below_temporal_high_pass_at_long_stops(
    table: ComparisonTable, pipeline: str
) -> None:
    for run in LONG_STOPS:
        assert peak(table, pipeline, run) < peak(table, "temporal-hpf", run), run


def test_each_step_of_the_spatial_chain_is_better_at_every_stop(table: ComparisonTable) -> None:
    for run in STOPS:
        basic = peak(table, "spatial-basic", run)
        timer = peak(table, "spatial-hpf-timer-distortion", run)
        assert basic > timer > peak(table, REFLECTION, run), run
        assert abs(table.cell(REFLECTION, run).mean.iri_error_percent) < 20.0, run


@pytest.mark.parametrize("pipeline", [*ADAPTIVE, REFLECTION])
def test_low_speed_suppression_loses_roughness_at_5_km_h(
    table: ComparisonTable, pipeline: str
) -> None:
    assert -95.0 < table.cell(pipeline, "const_5").mean.iri_error_percent < -35.0


def test_temporal_high_pass_keeps_it(table: ComparisonTable) -> None:
    assert abs(table.cell("temporal-hpf", "const_5").mean.iri_error_percent) < 10.0


@pytest.mark.parametrize("pipeline", ["temporal-hpf", "temporal-hpf-local-suppression", *ADAPTIVE])
def test_at_16_km_h_nothing_is_lost(table: ComparisonTable, pipeline: str) -> None:
    assert table.cell(pipeline, "const_16").mean.cross_correlation >= 0.98


def test_the_order_of_the_cells_is_that_in_print(table: ComparisonTable) -> None:
    """The rule "stop: low, else high" knows nothing of pipelines and has to be beaten."""
    ranks = rank_correlations(table)["chapter_5"]
    assert ranks.cells == 147
    assert ranks.ours is not None
    assert ranks.rule is not None
    assert ranks.ours >= 0.8 > ranks.rule
