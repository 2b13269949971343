"""The straightedge: a sine, a parabola and one bump in closed form."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.measures import rolling_straightedge, straightedge_deviation

INTERVAL, HALF = 0.0762, 20
"""10 ft at 3 in: 20 intervals from the middle to a wheel."""


def test_a_sine() -> None:
    """A sin(kx) (1 − cos(kL/2))."""
    for wavelength in (1.0, 3.048, 6.096, 30.0):
        k = 2.0 * np.pi / wavelength
        z = np.sin(k * INTERVAL * np.arange(400))
        expected = z * (1.0 - np.cos(k * HALF * INTERVAL))
        found = straightedge_deviation(z, INTERVAL)
        np.testing.assert_allclose(found[HALF:-HALF], expected[HALF:-HALF], atol=1e-12)


def test_a_crest_of_constant_curvature() -> None:
    """Of z = −c x² the middle is c (L/2)² high everywhere."""
    x = INTERVAL * np.arange(400)
    found = straightedge_deviation(-0.001 * x**2, INTERVAL)[HALF:-HALF]
    np.testing.assert_allclose(found, 0.001 * (HALF * INTERVAL) ** 2, rtol=1e-9)


def test_one_bump_is_seen_by_the_middle_and_by_both_wheels() -> None:
    z = np.zeros(400)
    z[200:204] = 0.008
    result = rolling_straightedge(z, INTERVAL, start_m=50.0)
    assert result.length_m == pytest.approx(3.048)
    assert result.largest_m == 0.008
    signs = [area.deviation_m for area in result.areas]
    assert signs == [-0.004, 0.008, -0.004]
    assert result.areas[1].start_m == pytest.approx(50.0 + 200 * INTERVAL)
    assert result.areas[1].end_m == pytest.approx(50.0 + 203 * INTERVAL)
    assert result.defective_share == pytest.approx(12 / 360)


def test_a_low_place_beside_a_high_one_is_an_area_of_its_own() -> None:
    z = np.zeros(400)
    z[200 : 200 + 2 * HALF] = 0.010
    low, high, last = rolling_straightedge(z, INTERVAL).areas
    assert [area.deviation_m for area in (low, high, last)] == [-0.005, 0.005, -0.005]
    assert high.start_m - low.end_m == pytest.approx(INTERVAL)


def test_a_deviation_at_the_tolerance_is_within_it() -> None:
    z = np.zeros(400)
    z[200] = 0.004
    assert len(rolling_straightedge(z, INTERVAL, tolerance_m=0.004).areas) == 0
    assert len(rolling_straightedge(z, INTERVAL, tolerance_m=0.003999).areas) == 1


def test_invalid_points_are_marked_and_counted() -> None:
    z, valid = np.zeros(400), np.ones(400, dtype=bool)
    z[200] = 0.008
    valid[219] = False
    result = rolling_straightedge(z, INTERVAL, valid=valid)
    shares = [area.valid_share for area in result.areas]
    assert shares == [1.0, 0.0, 0.0]
    assert result.valid_share == pytest.approx(1 - 41 / 360)


def test_a_profile_shorter_than_the_straightedge_has_no_result() -> None:
    result = rolling_straightedge(np.zeros(40), INTERVAL)
    assert np.isnan([result.largest_m, result.defective_share, result.valid_share]).all()
    assert result.areas == ()


@pytest.mark.parametrize(
    ("length", "tolerance", "text"),
    [(0.0, 0.003, "length"), (float("nan"), 0.003, "length"), (3.0, 0.0, "no limit")],
)
def test_impossible_numbers_are_refused(length: float, tolerance: float, text: str) -> None:
    with pytest.raises(InputError, match=text):
        rolling_straightedge(np.zeros(400), INTERVAL, length, tolerance)
