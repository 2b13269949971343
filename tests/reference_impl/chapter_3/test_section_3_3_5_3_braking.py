"""A kink where the brakes are released alters the roughness where print found it altered."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.chapter_3.section_3_3_5_3_braking import (
    TABLE_3_7_AVERAGE,
    TABLE_3_7_PEAK,
    TABLE_3_8,
    TABLE_3_9,
    Alteration,
    alteration,
    change,
    grouped,
    increase_of_iri,
)

DX, RELEASE = 0.1, 60.0
X = np.arange(1200) * DX
ROAD = np.random.default_rng(1).normal(size=X.size).cumsum() * 2e-4


def bump(place: float, height: float) -> np.ndarray:
    """Return a change of roughness over one base length from ``place`` past the release on."""
    inside = (RELEASE + place < X) & (RELEASE + place + 7.62 >= X)
    return np.where(inside, height, 0.0)


@pytest.mark.cites("Table 3.7", "Table 3.8", "Table 3.9")
@pytest.mark.parametrize(
    ("rows", "passes"),
    [(TABLE_3_7_PEAK, 64), (TABLE_3_7_AVERAGE, 64), (TABLE_3_8, 75), (TABLE_3_9, 75)],
)
def test_the_rows_hold_all_passes_in_rising_ranges(rows, passes: int) -> None:
    assert sum(row.passes for row in rows) == passes
    assert all(row.passes >= row.altered >= row.localized for row in rows)
    ends = [end for row in rows for end in (row.low, row.high)]
    assert ends == sorted(ends)


@pytest.mark.cites("Table 3.8", "Table 3.9")
def test_the_same_passes_are_altered_by_average_and_by_peak() -> None:
    for column in ("altered", "localized"):
        assert sum(getattr(r, column) for r in TABLE_3_8) == sum(
            getattr(r, column) for r in TABLE_3_9
        )


def test_1_m_per_km_raises_the_iri_of_a_tenth_of_a_mile_by_0_05() -> None:
    assert round(float(increase_of_iri(1.0)), 2) == 0.05


@pytest.mark.cites("Table 3.7")
@pytest.mark.parametrize("increase", [1.0, 4.0])
def test_a_kink_at_the_release_is_altered_within_the_printed_places(increase: float) -> None:
    """Print: the peak from -1.4 to 13.2 m, changes from -11.4 to 25.1 and from -18.2 to 31.5 m."""
    kink = np.maximum(X - RELEASE, 0.0)
    unit = change(kink, np.zeros_like(X), DX)
    found = alteration(unit * increase / unit.max(), DX, RELEASE, 0.1 * increase)
    assert found.case == 1
    assert found.localized
    assert float(found.increase) == pytest.approx(increase)
    assert -1.4 < float(found.peak) < 13.2
    assert -11.4 < float(found.begin) < 0
    assert 13.2 < float(found.end) < 31.5


@pytest.mark.cites("Table 3.7")
def test_a_kink_that_cancels_one_of_the_road_lowers_its_roughness() -> None:
    kink = 0.01 * np.maximum(X - RELEASE, 0.0)
    assert alteration(change(0.3 * kink, kink, DX), DX, RELEASE, 0.2).case == 3
    assert alteration(change(ROAD + 1e-7 * kink, ROAD, DX), DX, RELEASE, 0.2).case == 4


@pytest.mark.cites("Table 3.7")
@pytest.mark.parametrize(
    ("delta", "case", "localized"),
    [
        (bump(2, 0.5), 1, False),
        (bump(2, 1.0), 1, True),
        (bump(2, 0.5) - bump(12, 0.5), 2, False),
        (bump(2, 0.6) - bump(12, 0.45), 2, False),
        (bump(2, 0.6) - bump(12, 0.3), 1, False),
        (bump(2, 1.5) - bump(12, 0.5), 1, True),
        (bump(2, 0.5) - bump(12, 1.5), 3, False),
        (-bump(2, 0.5), 3, False),
        (bump(2, 0.15), 4, False),
    ],
)
def test_the_four_cases(delta, case: int, localized: bool) -> None:
    found = alteration(delta, DX, RELEASE, 0.2)
    assert (found.case, found.altered, found.localized) == (case, case < 4, localized)


@given(place=st.floats(-20, 20), threshold=st.floats(0.05, 0.9))
def test_places_count_from_the_release_whatever_the_threshold(place: float, threshold) -> None:
    found = alteration(bump(place, 1.0), DX, RELEASE, threshold)
    assert float(found.begin) == pytest.approx(place, abs=2 * DX)
    assert float(found.end) == pytest.approx(place + 7.62, abs=2 * DX)
    assert np.isnan(float(alteration(0 * X, DX, RELEASE, threshold).begin))


@pytest.mark.cites("Table 3.9")
def test_passes_are_counted_in_the_group_of_their_deceleration() -> None:
    zero = np.longdouble(0)
    unchanged, altered, increased = (
        Alteration(case, np.longdouble(by), zero, zero, zero)
        for case, by in [(4, 0.0), (2, 0.5), (1, 1.2)]
    )
    rows = grouped(
        [0.07, 0.214, 0.216, 0.30, 0.5],
        [unchanged, altered, increased, increased, altered],
        [(row.low, row.high) for row in TABLE_3_9],
    )
    assert [tuple(row)[2:] for row in rows] == [(2, 1, 0), (1, 1, 1), (1, 1, 1)]
