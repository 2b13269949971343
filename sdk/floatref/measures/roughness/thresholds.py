"""Wavelength thresholds: how much of the spectrum an index needs (Karamihas 2021, 2.1.4).

The mean rectified output of a Gaussian road is proportional to the standard deviation, the
root of the integral of the output spectrum (2.11); a threshold is the wavelength at which a
given share of it is captured.
"""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.quarter_car import (
    GOLDEN_CAR,
    KMH,
    RIDE_NUMBER_CAR,
    QuarterCar,
    moving_average_response,
)
from floatref.values.arrays import FloatArray


@dataclass(frozen=True)
class RoadSpectrum:
    """Sayers' spectral model relative to its white-noise slope: G_a/G_s in 1/m², G_e/G_s in m²."""

    acceleration_ratio: float
    elevation_ratio: float

    def slope_density(self, wave_number: FloatArray) -> FloatArray:
        """Return G'(ν)/G_s at ``wave_number`` in cycles/m, from (2.4) as in (2.5)."""
        squared = np.square(2.0 * np.pi * wave_number)
        return np.asarray(self.elevation_ratio * squared + 1.0 + self.acceleration_ratio / squared)


SAMPLE_ROADS = {
    "very wavy": RoadSpectrum(8.0, 0.0),
    "standard": RoadSpectrum(1.06, 0.0),
    "white noise slope": RoadSpectrum(0.0, 0.0),
    "choppy": RoadSpectrum(0.0, 0.08),
}
"""The roads of Table 2.3."""


@dataclass(frozen=True)
class ProfileIndex:
    """An index as its vehicle, simulated speed in km/h and moving average in m."""

    car: QuarterCar
    speed_kmh: float
    moving_average_m: float = 0.25

    def power_gain(self, wave_number: FloatArray) -> FloatArray:
        """Return |H_MA|²·|H_GCSS|² at ``wave_number`` in cycles/m (2.11)."""
        stroke = self.car.stroke_response(2.0 * np.pi * wave_number * self.speed_kmh * KMH)
        smoothed = moving_average_response(wave_number, self.moving_average_m)
        return np.asarray(np.square(np.abs(stroke) * smoothed))


INDICES = {
    "IRI": ProfileIndex(GOLDEN_CAR, 80.0),
    "GCARS120": ProfileIndex(GOLDEN_CAR, 120.0),
    "GCARS40": ProfileIndex(GOLDEN_CAR, 40.0),
    "PTRN": ProfileIndex(RIDE_NUMBER_CAR, 80.0),
}
"""The indices of Tables 2.4 to 2.6."""


@dataclass(frozen=True)
class WavelengthThresholds:
    """Wavelengths in m that capture the share: up to ``long_m``, down to ``short_m``."""

    long_m: float
    short_m: float


def wavelength_thresholds(
    road: RoadSpectrum, index: ProfileIndex = INDICES["IRI"], captured: float = 0.995
) -> WavelengthThresholds:
    """Return the wavelengths up to which, and down to which, ``captured`` of the index lies.

    Raises InputError unless 0 < ``captured`` < 1. Source: (2.4), (2.7) to (2.11);
    of Tables 2.4 to 2.6 for 0.995.
    """
    if not 0.0 < captured < 1.0:
        raise InputError(f"captured share is {captured}; it must lie between 0 and 1")
    # Wavelengths from 1 mm to 10 km hold the output spectrum to about 1e-9 of its power.
    log_wave_number = np.linspace(np.log(1e-4), np.log(1e3), 100_001)
    wave_number = np.exp(log_wave_number)
    density = index.power_gain(wave_number) * road.slope_density(wave_number) * wave_number
    power = np.concatenate(([0.0], np.cumsum(density[1:] + density[:-1])))
    shares = np.square(captured) * power[-1]
    at = np.interp([power[-1] - shares, shares], power, log_wave_number)
    long_m, short_m = np.exp(-at)
    return WavelengthThresholds(float(long_m), float(short_m))
