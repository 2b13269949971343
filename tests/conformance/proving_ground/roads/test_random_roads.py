from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.random_roads import (
    CLASSES,
    SayersCoefficients,
    coherence,
    iso8608_road,
    sayers_road,
)
from floatref_conformance.proving_ground.roads.road import Road

LENGTH_M = 1050.0
SPACING_M = 0.05
PIECE = 10_000
BANDS = [(0.03, 0.08), (0.08, 0.3), (0.3, 1.0), (1.0, 5.0)]
TABLE_2_2 = {
    "normal": (0.0, 20e-6, 0.0),
    "asphalt-long-waves": (7e-6, 20e-6, 0.0),
    "rough": (0.0, 100e-6, 1e-6),
    "limit": (0.0, 300e-6, 8e-6),
}
Transforms = dict[str, np.ndarray]


def transforms(road: Road) -> Transforms:
    """Windowed spectra of the pieces of each wheel path, one row per piece."""
    first = int(np.ceil((26.0 - road.start_m) / road.spacing_m))
    x = np.arange(PIECE)
    window = 0.5 - 0.5 * np.cos(2 * np.pi * x / PIECE)
    scale = np.sqrt(2 * road.spacing_m / np.sum(window**2))
    rows = {}
    for name, z in road.elevation.items():
        pieces = z[first : first + 2 * PIECE].reshape(2, PIECE)
        level = [piece - np.polyval(np.polyfit(x, piece, 1), x) for piece in pieces]
        rows[name] = scale * np.fft.rfft(window * np.array(level))
    return rows


def many(draw: Callable[[int], Road], seeds: int = 30) -> tuple[FloatArray, Transforms]:
    drawn = [transforms(draw(seed)) for seed in range(seeds)]
    rows = {name: np.concatenate([d[name] for d in drawn]) for name in drawn[0]}
    return np.fft.rfftfreq(PIECE, SPACING_M), rows


def assert_density(wave_number: FloatArray, spectra: np.ndarray, density: FloatArray) -> None:
    """Band averages of periodogram over density are 1 within four standard errors."""
    for low, high in BANDS:
        band = (wave_number >= low) & (wave_number < high)
        ratio = np.mean(np.abs(spectra[:, band]) ** 2 / density[band])
        independent = np.count_nonzero(band) * spectra.shape[0] / 2
        assert abs(ratio - 1) < 4 / np.sqrt(independent) + 0.02, (low, high, ratio)


@pytest.mark.slow
@pytest.mark.cites("(2.4)")
@pytest.mark.parametrize("case", TABLE_2_2)
def test_sayers_roads_have_the_spectrum_of_equation_2_4(case: str) -> None:
    wave_number, rows = many(lambda seed: sayers_road(case, LENGTH_M, seed, SPACING_M))
    g_a, g_s, g_e = TABLE_2_2[case]
    radian = 2 * np.pi * np.maximum(wave_number, 1e-9)
    density = g_e + g_s / radian**2 + g_a / radian**4
    for spectra in rows.values():
        assert_density(wave_number, spectra, density)


@pytest.mark.cites("(2.1)", "(14) of Zhu")
@pytest.mark.parametrize(("road_class", "level"), [("A", 16e-6), ("C", 256e-6), ("H", 262144e-6)])
def test_iso_roads_have_the_spectrum_of_their_class(road_class: str, level: float) -> None:
    wave_number, rows = many(lambda seed: iso8608_road(road_class, LENGTH_M, seed, SPACING_M), 5)
    density = level * (np.maximum(wave_number, 1e-9) / 0.1) ** -2
    assert_density(wave_number, rows["left"], density)


@given(st.integers(0, 2**32), st.integers(0, 6))
@settings(deadline=None, max_examples=10)
def test_each_iso_class_is_twice_as_high_as_the_one_before(seed: int, index: int) -> None:
    lower, upper = (
        iso8608_road(k, 60.0, seed, SPACING_M).elevation["right"]
        for k in CLASSES[index : index + 2]
    )
    np.testing.assert_allclose(upper, 2 * lower, rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("wave_number", [0.003, 0.02, 0.1, 0.3, 0.8])
def test_coherence_is_that_of_an_isotropic_surface(wave_number: float) -> None:
    apart = 1.72

    def surface(across: float) -> float:
        return float((wave_number**2 + across**2) ** -1.5)

    cross, _ = quad(surface, 0, np.inf, weight="cos", wvar=2 * np.pi * apart)
    own, _ = quad(surface, 0, np.inf)
    assert coherence(np.array([wave_number]), apart)[0] == pytest.approx(cross / own, abs=1e-4)


def test_wheel_paths_are_coherent_at_long_waves_and_independent_at_short_ones() -> None:
    wave_number, rows = many(lambda seed: sayers_road("normal", LENGTH_M, seed, SPACING_M))
    left, right = rows["left"], rows["right"]
    for low, high, least, most in [
        (0.004, 0.02, 0.95, 1.0),
        (0.09, 0.11, 0.45, 0.70),
        (1.0, 5.0, -0.03, 0.03),
    ]:
        band = (wave_number >= low) & (wave_number < high)
        cross = np.real(np.sum(left[:, band] * np.conj(right[:, band])))
        power = np.sum(np.abs(left[:, band]) ** 2) * np.sum(np.abs(right[:, band]) ** 2)
        assert least < cross / np.sqrt(power) < most


@given(st.integers(0, 2**32), st.floats(30.0, 300.0))
@settings(deadline=None, max_examples=10)
def test_a_finer_spacing_adds_short_waves_only(seed: int, length: float) -> None:
    coarse = sayers_road("normal", length, seed, 0.1).elevation["left"]
    fine = sayers_road("normal", length, seed, 0.05).elevation["left"][::2]
    count = min(coarse.size, fine.size)
    missing = 20e-6 / (2 * np.pi) ** 2 * (1 / 5.0 - 1 / 10.0)
    difference = (fine[:count] - coarse[:count])[460:]
    x = np.arange(difference.size)
    added = difference - np.polyval(np.polyfit(x, difference, 1), x)
    assert np.std(added) == pytest.approx(np.sqrt(missing), rel=0.3)


@given(st.integers(0, 2**32), st.floats(50.0, 200.0))
@settings(deadline=None, max_examples=10)
def test_seeds_repeat_and_differ_and_the_start_is_level(seed: int, length: float) -> None:
    first, again, other = (
        sayers_road("rough", length, s, SPACING_M) for s in (seed, seed, seed + 1)
    )
    for name in first.tracks:
        assert np.array_equal(first.elevation[name], again.elevation[name])
        assert not np.array_equal(first.elevation[name], other.elevation[name])
        assert not first.elevation[name][first.distance_m <= 6.0].any()


def test_unknown_cases_and_classes_are_refused() -> None:
    with pytest.raises(InputError, match="road case bumpy: unknown"):
        sayers_road("bumpy", 100.0, 0)
    with pytest.raises(InputError, match="class AB: unknown"):
        iso8608_road("AB", 100.0, 0)
    with pytest.raises(InputError, match="not be negative"):
        SayersCoefficients(0.0, -1e-6, 0.0)
