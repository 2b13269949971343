"""Laws of the road of sine waves: every wave is there, as high as its slope says."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M
from floatref_conformance.proving_ground.roads.sines import (
    SHARED_FROM_M,
    SLOPE,
    WAVELENGTHS_M,
    sines_road,
)


def amplitudes(x, z):
    """Return the complex amplitude of every wave beside a line, by plain least squares."""
    turns = np.outer(x, 2j * np.pi / WAVELENGTHS_M)
    line = np.stack([np.ones_like(x), x], axis=1)
    found = np.linalg.lstsq(np.hstack([np.exp(turns).real, np.exp(turns).imag, line]), z)[0]
    count = WAVELENGTHS_M.size
    return found[:count] - 1j * found[count : 2 * count]


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(seed=st.integers(0, 2**63 - 1))
def test_all_waves_have_one_slope_and_the_wheel_paths_share_the_long_ones(seed: int) -> None:
    road = sines_road(340.0, seed)
    inside = slice(int((FULL_FROM_M + 10 - road.start_m) / road.spacing_m), -1, 8)
    x = road.distance_m[inside]
    left, right = (amplitudes(x, road.elevation[name][inside]) for name in ("left", "right"))
    for found in (left, right):
        slopes = np.abs(found) * 2 * np.pi / WAVELENGTHS_M
        assert slopes == pytest.approx(SLOPE, rel=1e-3)
    apart = np.abs(np.angle(left / right))
    assert np.all(apart[WAVELENGTHS_M >= SHARED_FROM_M] < 1e-3)
    assert np.mean(apart[WAVELENGTHS_M < SHARED_FROM_M]) > 0.5


def test_it_starts_gently_and_is_level_under_no_sensor() -> None:
    road = sines_road(200.0, 3)
    for z in road.elevation.values():
        slopes = np.diff(z) / road.spacing_m
        behind = road.distance_m[1:] < FULL_FROM_M - 40.0
        assert np.abs(slopes[behind]).max() < 0.1 * np.abs(slopes).max()
        under_way = z[road.distance_m > -5.0]
        assert np.all(under_way[100:] != under_way[:-100])


def test_another_seed_draws_other_phases() -> None:
    one, other = (sines_road(200.0, seed).elevation["left"] for seed in (1, 2))
    assert not np.allclose(one, other)


def test_an_impossible_length_is_refused() -> None:
    with pytest.raises(InputError, match="length_m is 0"):
        sines_road(0.0, 1)
