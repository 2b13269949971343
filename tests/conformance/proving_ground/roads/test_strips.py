"""Strings beside a wheel path: correlated across as a measured surface is."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import agreement
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.random_roads import (
    coherence,
    sayers_road,
    spectral_road,
)
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M, LEVEL_UNTIL_M, Road
from floatref_conformance.proving_ground.roads.strips import (
    along_line,
    lateral_coherence,
    strip_around,
)
from floatref_conformance.proving_ground.roads.surface import Surface
from floatref_conformance.proving_ground.roads.wander import Line

BLOCK = Path(__file__).parent / "data" / "belgian-block" / "steps.npz"
APART_CM = (1, 5, 10, 50)
MEASURED = (0.934, 0.677, 0.560, 0.336)
"""Correlation of the slope across the whole measured file (data/belgian-block/SOURCE.md)."""


def white_slope(wave_number: FloatArray) -> FloatArray:
    return 20e-6 / (2 * np.pi * wave_number) ** 2


def road(length_m: float = 100.0, seed: int = 3, spacing_m: float = 0.005) -> Road:
    return spectral_road(white_slope, length_m, seed, spacing_m)


def correlations(elevation: FloatArray) -> list[float]:
    """Return the correlation of slopes over 1 cm, shape (strings, points), by distance across."""
    slope = np.diff(elevation, axis=1)
    return [float(np.corrcoef(slope[k:].flat, slope[:-k].flat)[0, 1]) for k in APART_CM]


def on_full_road(strip: Surface) -> FloatArray:
    """Return the strings every 1 cm from where the road carries its whole roughness."""
    return strip.elevation[:, round((FULL_FROM_M - strip.start_m) / strip.spacing_m) :: 2]


def test_the_measured_surface_has_the_correlations_of_its_file() -> None:
    with np.load(BLOCK) as stored:
        elevation = np.cumsum(stored["steps"], axis=0, dtype=np.int64).T / 1e4
    assert elevation.shape == (171, 1001)
    assert correlations(elevation) == pytest.approx(MEASURED, abs=0.012)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_strip_correlates_across_as_the_measured_surface(seed: int) -> None:
    strip = strip_around(road(200.0, seed), "left", seed, -0.3, 0.3)
    assert correlations(on_full_road(strip)) == pytest.approx(MEASURED, abs=0.03)


def test_the_model_averaged_over_white_slope_misses_no_figure_by_more_than_it_says() -> None:
    wave_number = np.linspace(1e-3, 100.0, 100_001)
    weight = np.sinc(0.01 * wave_number) ** 2
    for apart, measured in zip(APART_CM, MEASURED, strict=True):
        found = np.average(lateral_coherence(wave_number, apart / 100), weights=weight)
        assert found == pytest.approx(measured, abs=0.02)


def test_waves_keep_the_coherence_of_the_model() -> None:
    strip = on_full_road(strip_around(road(450.0), "right", 4, -0.2, 0.2))
    middle = strip.shape[0] // 2
    waves = np.fft.rfft(np.diff(strip) * np.hanning(strip.shape[1] - 1))
    wave_number = np.fft.rfftfreq(strip.shape[1] - 1, 0.01)
    for away in (5, 20):
        cross = (waves[middle] * waves[middle + away].conj()).real
        cross += (waves[middle] * waves[middle - away].conj()).real
        power = 2 * np.abs(waves[middle]) ** 2
        for low, high in ((0.1, 1.0), (2.0, 4.0), (8.0, 12.0), (30.0, 40.0)):
            band = (wave_number >= low) & (wave_number < high)
            expected = np.average(
                lateral_coherence(wave_number[band], away / 100), weights=power[band]
            )
            found = cross[band].sum() / power[band].sum()
            assert found == pytest.approx(expected, abs=0.06), (away, low)


@given(st.integers(0, 999), st.sampled_from(["left", "right"]), st.integers(0, 3))
@settings(deadline=None, max_examples=10)
def test_the_middle_string_is_the_wheel_path_bit_for_bit(seed: int, track: str, reach: int) -> None:
    ground = road(60.0, seed, 0.02)
    strip = strip_around(ground, track, seed, -0.01 * reach, 0.01 * reach)
    path = ground.elevation[track]
    assert np.array_equal(strip.line(np.zeros(ground.points)), path)
    assert not any(np.array_equal(row, path) for row in np.delete(strip.elevation, reach, axis=0))


def test_a_narrow_strip_is_a_part_of_a_wide_one() -> None:
    ground = road(60.0)
    wide = strip_around(ground, "left", 7)
    for right, left in ((-0.05, 0.05), (0.2, 0.25), (-0.4, -0.31), (0.1, 0.1)):
        part = strip_around(ground, "left", 7, right, left)
        first = round((part.right_m - wide.right_m) / 0.01)
        rows = wide.elevation[first : first + part.elevation.shape[0]]
        assert np.array_equal(part.elevation, rows)
        assert part.right_m <= right + 1e-9
        assert part.left_m >= left - 1e-9


def test_every_string_has_the_spectrum_of_its_path_and_its_level_start() -> None:
    ground = road(200.0)
    strip = strip_around(ground, "left", 1, -0.3, 0.3)
    slopes = np.diff(on_full_road(strip), axis=1).std(axis=1)
    assert slopes == pytest.approx(np.full(slopes.size, slopes[30]), rel=0.03)
    assert not strip.elevation[:, ground.distance_m <= LEVEL_UNTIL_M].any()
    steps = np.abs(np.diff(strip.elevation, axis=1)).max(axis=1)
    assert steps.max() < 7 * slopes[30]


def test_a_line_shifts_every_wheel_path_alike_and_passes_share_the_road() -> None:
    ground = road(60.0, spacing_m=0.02)
    line = Line(5, 0.1, 0.02)
    found = along_line(ground, line, 9)
    for track in ("left", "right"):
        wide = strip_around(ground, track, 9, -0.6, 0.6)
        exact = wide.line(line.at(ground.distance_m))
        assert found.elevation[track] == pytest.approx(exact, abs=1e-12)
    assert found.lateral_m == ground.lateral_m


def test_wheel_paths_a_line_shifts_keep_their_own_coherence() -> None:
    ground = road(1500.0, spacing_m=0.05)
    shifted = along_line(ground, Line(1, 0.2, 0.0), 2)
    full = ground.distance_m >= FULL_FROM_M
    waves = {k: np.fft.rfft(np.diff(z[full])) for k, z in shifted.elevation.items()}
    wave_number = np.fft.rfftfreq(np.count_nonzero(full) - 1, 0.05)
    band = (wave_number > 0.005) & (wave_number < 0.1)
    cross = (waves["left"] * waves["right"].conj()).real[band].sum()
    power = np.sqrt(np.prod([np.sum(np.abs(w[band]) ** 2) for w in waves.values()]))
    assert cross / power == pytest.approx(coherence(wave_number[band], 1.72).mean(), abs=0.1)


def test_both_wheel_paths_have_strips_of_their_own() -> None:
    ground = road(200.0, spacing_m=0.02)
    beside = [
        np.diff(strip_around(ground, track, 2, 0.3, 0.3).elevation[0] - ground.elevation[track])
        for track in ground.tracks
    ]
    assert abs(np.corrcoef(*beside)[0, 1]) < 0.05


@pytest.mark.slow
def test_passes_agree_by_their_distance_apart_as_in_print() -> None:
    """Nothing is fitted to it.

    4.5.3: all 14 pairs of passes 3 cm apart or less above 0.98 but one (0.976), a pair 5.2 cm apart
    0.993. 4.5.2: two passes 14 cm off the reference 0.949, with the errors of both devices.
    """
    scores: dict[int, list[float]] = {3: [], 5: [], 14: []}
    for seed in range(6):
        ground = sayers_road("normal", 220.0, seed)
        measured = strip_around(ground, "left", seed, 0.0, 0.14).elevation[:, 13200:-4000:5]
        for apart, found in scores.items():
            found.append(agreement(measured[0], measured[apart], 0.025).cross_correlation)
    assert np.mean(scores[3]) > 0.98
    assert min(scores[3]) > 0.97
    assert np.mean(scores[5]) == pytest.approx(0.993, abs=0.015)
    assert np.mean(scores[14]) == pytest.approx(0.949, abs=0.025)


def test_what_is_no_strip_is_refused() -> None:
    ground = road(60.0, spacing_m=0.1)
    with pytest.raises(InputError, match="wheel path middle: missing"):
        strip_around(ground, "middle", 1)
    for limits in ((0.1, -0.1), (float("nan"), 0.1)):
        with pytest.raises(InputError, match="right limit first"):
            strip_around(ground, "left", 1, *limits)
