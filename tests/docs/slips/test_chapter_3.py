"""Slips of chapter 3."""

import numpy as np

from floatref_reference.chapter_3.section_3_1_2_filters import anti_smoothing, cotangent


def test_profiler_6_ahead_of_the_brake_3_3_5_2() -> None:
    """Curvature from 100 to 125 m, as a brake leaves, is ahead of it for Profiler 5 alone."""
    x = np.arange(0.0, 300.0, 0.5)
    braked = np.clip(x - 100, 0, 25) ** 2 * 1e-3 + np.clip(x - 125, 0, None) * 0.05
    ahead = x < 100
    assert (cotangent(braked, 0.5)[ahead] == 0).all()
    assert np.abs(anti_smoothing(braked, 0.5)[ahead]).max() > 0.05
