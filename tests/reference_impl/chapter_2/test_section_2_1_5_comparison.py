"""Cross correlation, amplitude factor, offset search and the three wavebands."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2 import section_2_1_5_comparison as section

SEEDS = st.integers(0, 99)


def noise(seed: int, points: int = 300) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=points)


@pytest.mark.cites("(2.15)")
@settings(deadline=None, max_examples=10)
@given(seed=SEEDS, factor=st.floats(0.1, 10.0), mean=st.floats(-5.0, 5.0))
def test_amplitude_alone_lowers_the_score(seed: int, factor: float, mean: float) -> None:
    p = noise(seed)
    found = section.agreement(p, mean + factor * p, 0.1)
    assert found.rho_max == pytest.approx(1)
    assert found.gamma == pytest.approx(min(factor, 1 / factor))
    assert found.score == pytest.approx(min(factor, 1 / factor))
    assert found.x_off == 0


@settings(deadline=None, max_examples=10)
@given(seed=SEEDS, shift=st.integers(-10, 10))
def test_offset_is_positive_where_the_second_profile_lies_farther_along(
    seed: int, shift: int
) -> None:
    road = noise(seed, 400)
    p, q = road[50:350], road[50 - shift : 350 - shift]
    found = section.agreement(p, q, 0.1)
    assert found.x_off == pytest.approx(0.1 * shift)
    assert found.score == pytest.approx(1)


def test_search_stops_at_the_limit() -> None:
    road = noise(5, 400)
    assert section.agreement(road[50:350], road[39:339], 0.1).score < 0.5
    assert section.agreement(road[50:350], road[39:339], 0.1, 1.1).score == pytest.approx(1)


@pytest.mark.cites("(2.14)")
@settings(deadline=None, max_examples=10)
@given(seed=SEEDS)
def test_opposite_profiles_correlate_negatively(seed: int) -> None:
    p = noise(seed)
    assert section.correlation(p, -p, 0) == pytest.approx(-1)


@pytest.mark.cites("(2.13)")
@settings(deadline=None, max_examples=20)
@given(seed=SEEDS, i=st.integers(-5, 5))
def test_cross_correlation_function_is_the_mean_product(seed: int, i: int) -> None:
    p, q = noise(seed, 12), noise(seed + 100, 15)
    products = [p[k] * q[k + i] for k in range(12) if 0 <= k + i < 15]
    expected = sum(products) / len(products)
    assert section.cross_correlation(p, q, i) == pytest.approx(expected, abs=1e-14)
    assert abs(section.correlation(p, q, i)) <= 1 + 1e-12


def test_profiles_that_do_not_vary_have_no_correlation() -> None:
    assert section.correlation(np.ones(5), np.arange(5.0), 0) == 0
    assert section.amplitude_factor(np.ones(5), np.arange(5.0), 0) == 0
    assert section.amplitude_factor(np.ones(5), np.ones(5), 0) == 1


def test_profiles_without_overlap_are_refused() -> None:
    with pytest.raises(ValueError, match="lie apart"):
        section.correlation(np.ones(3), np.ones(3), 3)


@pytest.mark.parametrize(
    ("waveband", "inside", "outside"),
    [("short", 0.5, (6.0, 0.07)), ("medium", 3.6, (0.4, 30.0)), ("long", 23.0, (2.0, 300.0))],
)
def test_waveband_passes_its_own_wavelengths(
    waveband: str, inside: float, outside: tuple[float, float]
) -> None:
    dx, points = (0.02, 4000) if waveband == "short" else (0.2, 4000)

    def gain(wavelength: float) -> float:
        z = np.sin(2 * np.pi * dx * np.arange(points) / wavelength)
        passed = section.filtered(z, dx, waveband)[1000:3000]
        return float(passed.std() / section.slope(z, dx)[1000:3000].std())

    assert gain(inside) > 0.98
    assert max(gain(wavelength) for wavelength in outside) < 0.1


@pytest.mark.parametrize(
    ("waveband", "limit", "dx"),
    [
        ("short", 0.14, 0.01),
        ("short", 1.6, 0.02),
        ("medium", 1.6, 0.1),
        ("medium", 8.0, 0.1),
        ("long", 8.0, 0.1),
        ("long", 65.6, 0.2),
    ],
)
def test_limits_of_a_waveband_are_the_cut_offs_of_each_pass(
    waveband: str, limit: float, dx: float
) -> None:
    z = np.sin(2 * np.pi * dx * np.arange(6000) / limit)
    passed = section.filtered(z, dx, waveband)[2000:4000]
    ratio = passed.std() / section.slope(z, dx)[2000:4000].std()
    assert float(ratio) == pytest.approx(0.5, abs=0.02)


def test_iri_filter_is_the_first_three_steps() -> None:
    z = noise(7) * 1e-3
    assert section.filtered(z, 0.1).shape == (299,)
    assert (section.filtered(z, 0.1) == section.iri_trace(z, 0.1)).all()
