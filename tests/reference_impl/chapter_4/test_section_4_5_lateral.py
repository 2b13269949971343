"""On a surface of known lateral correlation the score is that correlation."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2.section_2_1_5_comparison import filtered
from floatref_reference.chapter_4.section_4_5_lateral import (
    REFERENCE_QUALITY,
    Pass,
    agreement_by_bias,
    footprint,
    lateral_separation,
    repeatability_by_separation,
    tracking_bias,
    within,
)

DX, POINTS = 0.5, 321
KAPPA = math.acos(0.949) / 0.14
"""Of the surface that scores 0.949 at 14 cm, as both passes of figure 4.8 do, in 1/m."""


def surface() -> tuple[np.ndarray, np.ndarray]:
    """Return two roads whose traces have one spread and no correlation."""
    rng = np.random.default_rng(5)
    a, b = (rng.normal(size=POINTS).cumsum() * 1e-3 for _ in range(2))
    trace_a, trace_b = (filtered(z, DX).astype(float) for z in (a, b))
    b = b - a * np.cov(trace_a, trace_b)[0, 1] / np.var(trace_a, ddof=1)
    return a, b * np.std(trace_a) / np.std(filtered(b, DX).astype(float))


A, B = surface()


def driven(leftward: float) -> Pass:
    """Return a pass ``leftward`` of the reference: the correlation is cos(κ times that)."""
    z = A * math.cos(KAPPA * leftward) + B * math.sin(KAPPA * leftward)
    return Pass(np.full(20, leftward), z)


@settings(max_examples=10, deadline=None)
@given(leftward=st.floats(-0.3, 0.3))
def test_the_score_is_the_correlation_of_the_surface(leftward: float) -> None:
    point = agreement_by_bias([driven(leftward)], driven(0.0), DX, 0.0)[0]
    assert float(point.offset) == pytest.approx(leftward)
    assert float(point.score) == pytest.approx(math.cos(KAPPA * leftward), abs=1e-6)


def test_a_surface_with_figure_4_8s_score_has_the_other_scores_of_the_text() -> None:
    """0.949 at 14 cm: above 0.98 below 6.5 cm, 0.993 at 5.2 cm, above 0.98 up to 3 cm."""
    offsets = [0.14, 0.064, -0.064, 0.01]
    points = agreement_by_bias([driven(y) for y in offsets], driven(0.0), DX, 0.0)
    assert float(points[0].score) == pytest.approx(0.949, abs=1e-6)
    assert len(within(points, 0.065)) == 3
    assert all(point.score > REFERENCE_QUALITY for point in within(points, 0.065))
    pair = repeatability_by_separation([driven(0.14), driven(0.192)], DX, 0.0)[0]
    assert float(pair.offset) == pytest.approx(0.052)
    assert float(pair.score) == pytest.approx(0.993, abs=5e-4)


def test_28_passes_have_378_pairs() -> None:
    passes = [Pass(np.full(4, 0.01 * n), A[:12]) for n in range(28)]
    points = repeatability_by_separation(passes, DX, 0.0)
    assert len(points) == 378
    assert [float(p.offset) for p in points[:27]] == pytest.approx(list(0.01 * np.arange(1, 28)))
    assert all(point.score > 1 - 1e-12 for point in points)


@given(seed=st.integers(0, 99))
def test_a_bias_cancels_where_a_separation_does_not(seed: int) -> None:
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, 30))
    assert float(tracking_bias(p, q)) == pytest.approx(float(np.mean(p - q)))
    assert float(lateral_separation(p, q)) == pytest.approx(float(np.mean(np.abs(p - q))))
    assert abs(tracking_bias(p, q)) <= lateral_separation(p, q) == lateral_separation(q, p)


def test_roll_moves_the_footprint_below_an_antenna_sideways() -> None:
    """Left side up by 0.02 rad, two metres below the antenna: 4 cm to the left."""
    level = footprint([10, 1, 3], 0.0, 0.0, 0.0, [0.5, 0.8, -2.0])
    assert level == pytest.approx(np.array([10.5, 1.8, 1.0]))
    rolled = footprint([10, 1, 3], 0.0, 0.0, 0.02, [0.5, 0.8, -2.0])
    assert rolled[1] - level[1] == pytest.approx(0.04, abs=5e-4)
    turned = footprint([10, 1, 3], math.pi / 2, 0.0, 0.0, [0.5, 0.8, -2.0])
    assert turned == pytest.approx(np.array([9.2, 1.5, 1.0]))
