"""Filters for comparing profiles: the printed recursions, gains, gaps, and agreement in a band."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import BANDS, WAVEBANDS, agreement, high_pass, waveband_slope
from floatref.measures.roughness.zero_phase import high_pass_b3x2, low_pass_b3x2
from floatref_reference.appendix_a import filters

FEW = settings(deadline=None, max_examples=10)
seeds = st.integers(0, 2**32 - 1)


def rough_road(seed: int, interval: float = 0.05, length: float = 250.0) -> np.ndarray:
    count = int(length / interval)
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 2e-3, count)) * np.sqrt(interval)


def gain(filtered: np.ndarray, wave: np.ndarray) -> float:
    """Amplitude ratio in the middle half, away from the ends."""
    middle = slice(wave.size // 4, 3 * wave.size // 4)
    return float(np.std(filtered[middle]) / np.std(wave[middle]))


@pytest.mark.parametrize(
    ("wavelength", "expected"), [(91.44, 0.5**0.5), (42.9, 0.996), (65.6, 0.947), (2.0, 1.0)]
)
def test_high_pass_has_its_printed_gains(wavelength: float, expected: float) -> None:
    interval = 0.25
    wave = np.sin(2 * np.pi * interval * np.arange(16_000) / wavelength)
    assert gain(high_pass(wave, interval), wave) == pytest.approx(expected, abs=6e-4)


@pytest.mark.parametrize("band", list(WAVEBANDS))
def test_each_limit_of_a_band_halves_the_slope(band: str) -> None:
    long_m, short_m = WAVEBANDS[band]
    for wavelength in (long_m, short_m):
        interval = wavelength / 400
        count = round(60 * long_m / interval) if wavelength == long_m else 30_000
        x = interval * np.arange(count)
        wave = np.sin(2 * np.pi * x / wavelength)
        slope = np.diff(wave) / interval
        # Both passes at λc give ½; the other limit is far enough to add under 2 %.
        other = 1 / (1 + min(short_m / long_m, 1) ** 6)
        assert gain(waveband_slope(wave, interval, band), slope) == pytest.approx(
            0.5 * other, rel=2e-3
        )


def test_wavebands_hold_the_waveband_of_interest_without_a_hole() -> None:
    assert WAVEBANDS["long"].short_m == WAVEBANDS["medium"].long_m
    assert WAVEBANDS["medium"].short_m == WAVEBANDS["short"].long_m


@given(seed=seeds, datum=st.floats(-500, 500))
@FEW
def test_high_pass_removes_the_datum(seed: int, datum: float) -> None:
    z = rough_road(seed)
    np.testing.assert_allclose(high_pass(z + datum, 0.05), high_pass(z, 0.05), atol=1e-8)


@given(seed=seeds)
@FEW
def test_high_pass_marks_gaps_and_filters_the_bridge(seed: int) -> None:
    z = rough_road(seed)
    gap, line = z.copy(), z.copy()
    gap[:10] = gap[1000:1101] = np.nan
    line[999:1102] = np.linspace(z[999], z[1101], 103)
    found, expected = high_pass(gap, 0.05), high_pass(line[10:], 0.05)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(gap))
    seen = ~np.isnan(gap[10:])
    np.testing.assert_allclose(found[10:][seen], expected[seen], atol=1e-12)


@pytest.mark.parametrize("band", BANDS)
def test_error_shows_in_the_band_that_holds_it(band: str) -> None:
    z = rough_road(3)
    x = 0.05 * np.arange(z.size)
    wavelengths = {"long": 25.0, "medium": 3.6, "short": 0.5, "iri": 2.4}
    amplitude = {"long": 0.02, "medium": 3e-3, "short": 1e-3, "iri": 3e-3}
    wrong = z + amplitude[band] * np.sin(2 * np.pi * x / wavelengths[band])
    scores = {name: agreement(z, wrong, 0.05, name).cross_correlation for name in BANDS}
    assert scores[band] < 0.9
    untouched = {"long": "short", "medium": "long", "short": "long", "iri": "long"}[band]
    assert scores[untouched] > 0.97


def test_only_what_both_measured_is_compared() -> None:
    z = rough_road(6)
    p, q = z.copy(), z.copy()
    p[:400] = np.nan
    q[-300:] = np.nan
    common = slice(400, -300)
    assert agreement(p, 2 * q, 0.05) == agreement(z[common], 2 * z[common], 0.05)


def test_low_pass_is_left_out_where_the_profile_holds_nothing_shorter() -> None:
    x = 0.1 * np.arange(4000)
    wave = np.sin(2 * np.pi * x / 0.4)
    slope = np.diff(wave) / 0.1
    assert gain(waveband_slope(wave, 0.1, "short"), slope) == pytest.approx(1.0, abs=1e-3)


def test_unusable_filters_are_refused() -> None:
    z = rough_road(7)
    nothing = np.where(np.arange(z.size) < 2000, z, np.nan)
    rest = np.where(np.arange(z.size) < 2000, np.nan, z)
    with pytest.raises(InputError, match=r"band 'loud': unknown; known: iri, long"):
        agreement(z, z, 0.05, "loud")
    with pytest.raises(InputError, match=r"at 0.8 m holds no wavelengths of 1.6 m"):
        agreement(z, z, 0.8, "short")
    with pytest.raises(InputError, match=r"holds no wavelengths of 0.1 m"):
        high_pass(z, 0.05, 0.1)
    with pytest.raises(InputError, match="share no two measured points"):
        agreement(nothing, rest, 0.05)
    with pytest.raises(InputError, match="cut them to the same points"):
        agreement(z, z[1:], 0.05)
    with pytest.raises(InputError, match="starts or ends with NaN"):
        waveband_slope(rest, 0.05, "long")


INTERVAL = 0.00508


@pytest.mark.parametrize(
    ("fast", "literal"),
    [(high_pass_b3x2, filters.hpf_b3x2), (low_pass_b3x2, filters.lpf_b3x2)],
)
@settings(deadline=None, max_examples=15)
@given(wavelength=st.floats(3.0, 500.0), seed=st.integers(0, 2**32 - 1))
def test_each_set_is_the_printed_one(fast, literal, wavelength, seed):
    x = np.random.default_rng(seed).standard_normal(300)
    expected = literal(x, 1.0 / wavelength, 1.0)
    assert np.abs(fast(x, 1.0, wavelength) - expected).max() <= 1e-11


def gain_in_the_middle(wavelength, cutoff):
    """Gain of HPF_B3x2 at ``wavelength``, read in the middle of a long sine."""
    points = round(12 * max(wavelength, cutoff) / 0.25)
    x = np.cos(2 * np.pi * (np.arange(points) - points // 2) * 0.25 / wavelength)
    return high_pass_b3x2(x, 0.25, cutoff)[points // 2]


@pytest.mark.parametrize(
    ("wavelength", "printed", "digits"),
    [(42.9, 0.996, 3), (65.6, 0.947, 3), (91.44, 0.5**0.5, 4)],
)
def test_the_gains_printed_in_section_5_3(wavelength, printed, digits):
    assert round(gain_in_the_middle(wavelength, 105.91), digits) == round(printed, digits)


def test_the_cut_off_setting_puts_3_db_where_it_is_asked_for():
    setting = (2.0**0.5 - 1.0) ** (1.0 / 6.0)
    assert gain_in_the_middle(40.0, 40.0 / setting) == pytest.approx(0.5**0.5, abs=1e-4)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 2**32 - 1))
def test_the_middle_of_a_long_signal_has_no_phase(seed):
    x = np.zeros(4001)
    x[1500:2501] = np.random.default_rng(seed).standard_normal(1001)
    mirrored = high_pass_b3x2(x[::-1].copy(), 1.0, 60.0)[::-1]
    assert np.abs(high_pass_b3x2(x, 1.0, 60.0) - mirrored).max() <= 1e-9


def test_one_point_and_none():
    assert high_pass_b3x2(np.zeros(0), INTERVAL, 105.91).size == 0
    assert low_pass_b3x2(np.array([2.0]), INTERVAL, 1.0) == pytest.approx([2.0])
