"""Slips in the print of appendix A: the printed form fails, the mended one holds."""

import numpy as np
import pytest

from floatref_reference.appendix_a import filters
from floatref_reference.appendix_a.digitization import (
    analog_cut_off,
    backward,
    substitution,
    transfer_function,
)
from floatref_reference.appendix_a.initialization import hpf_b3s2r_start
from floatref_reference.appendix_a.table_a_1 import (
    Coefficients,
    hpf_b3s1_coefficients,
    hpf_b3s2_coefficients,
)

F_C = 0.03


def start_as_printed(x: np.ndarray, row: Coefficients) -> list[np.longdouble]:
    D, N = row
    last = -(D[1] + D[2]) / D[0] * x[-1]
    return [last, (N[0] * x[-1] + (N[1] + N[2]) * x[-2] - (D[1] + D[2]) * last) / D[0]]


def test_start_of_the_reverse_stage_a_19() -> None:
    """Backward over a signal is forward over its mirror image, from the first sample on."""
    x = np.random.default_rng(2).normal(size=40).astype(np.longdouble)
    row = hpf_b3s2_coefficients(substitution(F_C, 1.0))
    mirrored = filters.hpf_b3s2(x[::-1], F_C, 1.0)[::-1]
    mended = backward(x, row, hpf_b3s2r_start(x, row))
    assert np.array(mended) == pytest.approx(mirrored, abs=1e-15)
    printed = backward(x, row, start_as_printed(x, row))
    assert abs(float(printed[-2] - mirrored[-2])) > 0.1


def gain(step: float) -> float:
    """Return the gain of HPF_B3x2 at 91.44 m for λ_c = 105.91 m, digitized with ``step``."""
    rows = (hpf_b3s1_coefficients, hpf_b3s2_coefficients)
    c = substitution(1 / 105.91, step)
    one_way = [transfer_function(row(c), 1 / 91.44, 0.00508) for row in rows]
    return abs(one_way[0] * one_way[1]) ** 2


def test_distance_increment_a_5() -> None:
    """A profile every 5.08 mm of signals every 1/16000 s: the filter's step is the distance."""
    assert gain(0.00508) == pytest.approx(0.5**0.5, abs=1e-4)
    assert gain(1 / 16_000) > 0.999
    assert float(analog_cut_off(1 / 105.91, 0.00508)) == pytest.approx(2 * np.pi / 105.91, rel=1e-6)
