"""Deviations from the moving average: a sine, a parabola and one bump in closed form."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import bumps_and_dips, deviation_from_average

INTERVAL = 0.0762
HALF = 50
"""Points of 25 ft on one side of the centre at 3 in."""


def bump(height: float, first: int, count: int, points: int = 600) -> np.ndarray:
    z = np.zeros(points)
    z[first : first + count] = height
    return z


@pytest.mark.parametrize("wavelength", [2.0, 5.0, 7.62, 15.0, 40.0])
def test_a_sine(wavelength: float) -> None:
    """1 less the gain of a mean of 2n + 1 points, sin((2n + 1)a)/((2n + 1) sin a), a = πΔ/λ."""
    z = np.sin(2.0 * np.pi * INTERVAL * np.arange(800) / wavelength)
    a, window = np.pi * INTERVAL / wavelength, 2 * HALF + 1
    expected = z * (1.0 - np.sin(window * a) / (window * np.sin(a)))
    found = deviation_from_average(z, INTERVAL)
    np.testing.assert_allclose(found[HALF:-HALF], expected[HALF:-HALF], atol=1e-12)


def test_a_parabola_lies_below_its_average_everywhere() -> None:
    """Of z = k² the mean over k ± n is k² + n(n + 1)/3."""
    z = np.arange(400.0) ** 2 * 1e-6
    found = deviation_from_average(z, INTERVAL)[HALF:-HALF]
    np.testing.assert_allclose(found, -1e-6 * HALF * (HALF + 1) / 3.0, rtol=1e-9)


def test_one_bump() -> None:
    """A bump of 10 points and 5 mm is 5 mm (1 − 10/101) high; its ends are its own."""
    (found,) = bumps_and_dips(bump(0.005, 300, 10), INTERVAL, start_m=100.0)
    assert found.kind == "bump"
    assert found.deviation_m == pytest.approx(0.005 * (1.0 - 10.0 / 101.0))
    assert found.start_m == pytest.approx(100.0 + 300 * INTERVAL)
    assert found.end_m == pytest.approx(100.0 + 309 * INTERVAL)
    assert found.valid_share == 1.0


def test_a_dip_is_a_bump_upside_down() -> None:
    z = bump(0.005, 300, 10)
    (up,), (down,) = bumps_and_dips(z, INTERVAL), bumps_and_dips(-z, INTERVAL)
    assert (up.kind, down.kind) == ("bump", "dip")
    assert (up.start_m, up.end_m, up.deviation_m) == (down.start_m, down.end_m, -down.deviation_m)


@pytest.mark.parametrize(("height", "count"), [(0.0038, 0), (0.0043, 1)])
def test_the_limit_is_0_150_in(height: float, count: int) -> None:
    """0.0043 (1 − 10/101) is above 3.81 mm."""
    assert len(bumps_and_dips(bump(height, 300, 10), INTERVAL)) == count


@given(slope=st.floats(-0.1, 0.1), level=st.floats(-1000.0, 1000.0))
def test_a_straight_slope_has_neither(slope: float, level: float) -> None:
    z = level + slope * INTERVAL * np.arange(400)
    assert bumps_and_dips(z, INTERVAL) == ()


def test_half_a_base_at_each_end_and_gaps_are_not_judged() -> None:
    z = bump(0.005, 300, 10)
    z[:20], z[303:306] = np.nan, np.nan
    found = deviation_from_average(z, INTERVAL)
    judged = np.flatnonzero(np.isfinite(found))
    assert (judged[0], judged[-1]) == (20 + HALF, z.size - 1 - HALF)
    assert np.isnan(found[303:306]).all()
    assert np.isnan(deviation_from_average(z[:60], INTERVAL)).all()


def test_what_rests_on_invalid_points_is_marked() -> None:
    valid = np.ones(600, dtype=bool)
    valid[355] = False
    (found,) = bumps_and_dips(bump(0.005, 300, 10), INTERVAL, valid=valid)
    # The windows of points 305 to 309 reach point 355.
    assert found.valid_share == 0.5


@pytest.mark.parametrize("limit", [0.0, -1.0, float("nan")])
def test_an_impossible_limit_is_refused(limit: float) -> None:
    with pytest.raises(InputError, match="no limit"):
        bumps_and_dips(np.zeros(400), INTERVAL, limit)


@pytest.mark.parametrize("base", [0.0, -7.62, float("inf")])
def test_an_impossible_base_is_refused(base: float) -> None:
    with pytest.raises(InputError, match="base length"):
        deviation_from_average(np.zeros(400), INTERVAL, base)
