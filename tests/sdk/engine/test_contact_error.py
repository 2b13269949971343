"""What a tyre levels, against roads that are drawn and levelled."""

import numpy as np
import pytest

from floatref.engine.validity_and_sigma import add_contact_error


@pytest.mark.parametrize("contact_m", [0.1, 0.25])
def test_the_levelled_waves_have_the_predicted_size(contact_m: float) -> None:
    interval = 0.005
    steps = np.random.default_rng(0).standard_normal(200_000)
    road = 1e-4 * np.cumsum(steps)
    points = round(contact_m / interval)
    level = np.convolve(road, np.ones(points) / points, "same")
    lost = (road - level)[points:-points]
    sigma = np.zeros(road.size)
    add_contact_error(sigma, level, interval, contact_m)
    assert np.median(sigma) == pytest.approx(lost.std(), rel=0.08)


def test_it_adds_to_what_is_there_as_independent_and_passes_over_gaps() -> None:
    road = 1e-3 * np.random.default_rng(1).standard_normal(4000).cumsum()
    alone, beside = np.zeros(road.size), np.full(road.size, 3e-3)
    add_contact_error(alone, road, 0.05, 0.25)
    add_contact_error(beside, road, 0.05, 0.25)
    np.testing.assert_allclose(beside, np.hypot(3e-3, alone))
    road[1000:1100] = np.nan
    holed = np.zeros(road.size)
    add_contact_error(holed, road, 0.05, 0.25)
    assert np.isfinite(holed).all()
