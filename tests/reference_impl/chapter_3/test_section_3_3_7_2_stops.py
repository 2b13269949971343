"""A step of the elevation at a stop contaminates what print shows around figure 3.25's."""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_3.section_3_3_5_3_braking import change
from floatref_reference.chapter_3.section_3_3_7_2_stops import (
    TABLE_3_10,
    Contamination,
    contaminated,
    widest,
)

DX, STOP = 0.1, 60.0
X = np.arange(1800) * DX
K_1, K_2, C, MU = 653.0, 63.3, 6.0, 0.15


@cache
def step() -> np.ndarray:
    """Return the change of roughness by a step that raises it by 1 m/km at most."""
    delta = change(np.where(X > STOP, 1.0, 0.0), np.zeros_like(X), DX)
    return (delta / delta.max()).astype(float)


def slowest_decay() -> float:
    """Return the rate in 1/m at which the golden car's slowest motion dies out at 80 km/h."""
    A = [[0, 1, 0, 0], [-K_2, -C, K_2, C], [0, 0, 0, 1]]
    A.append([K_2 / MU, C / MU, -(K_1 + K_2) / MU, -C / MU])
    return -max(np.linalg.eigvals(np.array(A)).real) / (80 / 3.6)


@pytest.mark.cites("Table 3.10")
def test_the_table_has_the_texts_extremes() -> None:
    assert min(row.upstream for row in TABLE_3_10) == -47.3
    assert max(row.downstream for row in TABLE_3_10) == 75.6
    second = next(row for row in TABLE_3_10 if (row.profiler, row.side) == (2, "left"))
    assert (second.upstream, second.downstream, second.passes) == (-14.1, 48.7, 12)


@pytest.mark.cites("Table 3.10")
def test_a_step_of_figure_3_25_peaks_and_ends_where_print_has_it() -> None:
    """A peak of 55.4 m/km 3.2 m past the stop, and agreement from 37.5 m past it on."""
    found = contaminated(55.4 * step(), DX, STOP, 0.5)
    assert float(found.peak) == pytest.approx(55.4)
    assert X[step().argmax()] - STOP == pytest.approx(3.2, abs=0.6)
    assert float(found.downstream) == pytest.approx(37.5, abs=2.5)


def test_nothing_but_the_average_reaches_upstream_of_a_step() -> None:
    """The brakes do the rest of print's 8.5 m: 3.81 m are half a base length."""
    assert float(contaminated(55.4 * step(), DX, STOP, 0.01).upstream) == pytest.approx(
        -3.81, abs=DX
    )


@settings(max_examples=20)
@given(peak=st.floats(10.0, 300.0), growth=st.floats(2.0, 5.0))
def test_a_higher_step_reaches_farther_by_the_decay_of_the_car(peak: float, growth: float) -> None:
    low, high = (contaminated(p * step(), DX, STOP, 0.2) for p in (peak, growth * peak))
    farther = float(high.downstream - low.downstream)
    half_a_wave = 80 / 3.6 / 1.2 / 2
    assert farther == pytest.approx(math.log(growth) / slowest_decay(), abs=half_a_wave)


@given(gap=st.floats(0.5, 20.0))
def test_agreement_over_a_base_length_ends_it(gap: float) -> None:
    near = np.where(abs(X - STOP) < 5, 1.0, 0.0)
    far = np.where((STOP + 5 + gap <= X) & (STOP + 8 + gap > X), 1.0, 0.0)
    found = contaminated(near + far, DX, STOP, 0.5)
    end = 8 + gap if gap < 7.4 else 5
    if abs(gap - 7.6) > 0.3:
        assert float(found.downstream) == pytest.approx(end, abs=2 * DX)
    assert float(found.upstream) == pytest.approx(-5, abs=2 * DX)


def test_profiles_that_agree_have_no_contaminated_length() -> None:
    assert contaminated(0.1 * step(), DX, STOP, 0.5) == Contamination(
        *(np.longdouble(v) for v in (0.1 * step()[600], 0, 0))
    )


@pytest.mark.cites("Table 3.10")
def test_a_row_has_the_range_of_peaks_and_the_widest_length() -> None:
    passes = [contaminated(p * step(), DX, STOP, 0.2) for p in (48.0, 70.0, 99.0)]
    row = widest(2, "left", passes)
    assert (row.passes, row.lowest, row.highest) == (3, pytest.approx(48), pytest.approx(99))
    assert row.downstream == float(passes[2].downstream) > float(passes[0].downstream)
    assert row.upstream == float(passes[2].upstream)
