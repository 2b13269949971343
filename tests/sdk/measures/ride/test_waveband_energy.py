"""RMS elevation and slope in a band: a sine in closed form, and what a band leaves out."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import WAVEBANDS, Waveband, waveband_elevation, waveband_energy

INTERVAL = 0.05


def gain(wavelength: float, band: Waveband) -> float:
    """Return r⁶/(1 + r⁶) of the high-pass times 1/(1 + r⁶) of the low-pass."""

    def ratio(limit: float) -> float:
        return math.tan(math.pi * INTERVAL / wavelength) / math.tan(math.pi * INTERVAL / limit)

    high, low = ratio(band.long_m) ** 6, ratio(band.short_m) ** 6
    return high / (1.0 + high) / (1.0 + low)


@pytest.mark.parametrize("wavelength", [0.5, 1.6, 4.0, 8.0, 20.0])
@pytest.mark.parametrize("band", ["medium", "long"])
def test_a_sine(wavelength: float, band: str) -> None:
    """A/√2 and A k/√2 times the gain; sin(a)/a of the finite difference, a = πΔ/λ."""
    limits, amplitude = WAVEBANDS[band], 0.002
    # Whole waves between the first and the last point, so that the continuation is one as well.
    waves = 40 if wavelength > 2.0 else 400
    count = round(waves * wavelength / INTERVAL)
    z = amplitude * np.sin(2.0 * np.pi * INTERVAL * np.arange(count + 1) / wavelength)
    found = waveband_energy(z, INTERVAL, limits)
    expected = amplitude / math.sqrt(2.0) * gain(wavelength, limits)
    assert found.rms_elevation_m == pytest.approx(expected, rel=2e-3, abs=1e-7)
    angle = math.pi * INTERVAL / wavelength
    slope = expected * 2.0 * math.pi / wavelength * math.sin(angle) / angle
    assert found.rms_slope == pytest.approx(slope, rel=2e-3, abs=1e-6)


@given(slope=st.floats(-0.1, 0.1), level=st.floats(-1000.0, 1000.0))
@settings(deadline=None, max_examples=20)
def test_level_and_slope_are_in_no_band(slope: float, level: float) -> None:
    z = level + slope * INTERVAL * np.arange(500)
    for band in WAVEBANDS.values():
        assert waveband_energy(z, INTERVAL, band).rms_elevation_m < 1e-10


def test_bands_side_by_side_hold_the_road_between_them() -> None:
    """High-pass and low-pass at one limit add up to 1, so that the bands add up to the whole."""
    z = np.cumsum(np.random.default_rng(4).normal(0.0, 5e-4, 4000))
    parts = sum(waveband_elevation(z, INTERVAL, band) for band in (Waveband(20, 5), Waveband(5, 1)))
    whole = waveband_elevation(z, INTERVAL, Waveband(20, 1))
    middle = slice(500, -500)
    assert np.std((parts - whole)[middle]) < 0.02 * np.std(whole[middle])


def test_the_share_of_valid_points_is_of_the_measured_stretch() -> None:
    z, valid = np.zeros(500), np.ones(500, dtype=bool)
    z[:100], valid[300:340] = np.nan, False
    assert waveband_energy(z, INTERVAL, Waveband(8.0, 1.6), valid).valid_share == 0.9


@pytest.mark.parametrize("band", [(1.6, 8.0), (8.0, 0.0), (float("nan"), 1.0)])
def test_an_impossible_band_is_refused(band: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="longest wavelength in m, then its shortest"):
        waveband_energy(np.zeros(500), INTERVAL, Waveband(*band))


def test_a_band_that_the_profile_cannot_hold_is_refused() -> None:
    with pytest.raises(InputError, match=r"holds no wavelengths of 1\.6 m"):
        waveband_energy(np.zeros(500), 1.0, WAVEBANDS["short"])
    with pytest.raises(InputError, match="1 point"):
        waveband_energy(np.zeros(1), INTERVAL, Waveband(8.0, 1.6))
