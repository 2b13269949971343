"""2.1.4.1 Spectral Models of road profiles."""

import math
from typing import NamedTuple


class SpectralModel(NamedTuple):
    """Coefficients of three sources of white noise.

    Equation:
        (2.4)

    Args:
        G_e: white noise elevation, m³/cycle.
        G_s: white noise slope, m/cycle.
        G_a: white noise spatial acceleration, 1/(m·cycle).
    """

    G_e: float
    G_s: float
    G_a: float


TABLE_2_2 = {
    "normal": SpectralModel(G_e=0.0, G_s=20e-6, G_a=0.0),
    "asphalt with long waves": SpectralModel(G_e=0.0, G_s=20e-6, G_a=7e-6),
    "rough (short waves)": SpectralModel(G_e=1e-6, G_s=100e-6, G_a=0.0),
    "limit roughness": SpectralModel(G_e=8e-6, G_s=300e-6, G_a=0.0),
}
"""Table 2.2: four sample roads."""

TABLE_2_3 = {
    "very wavy": SpectralModel(G_e=0.0, G_s=1.0, G_a=8.0),
    "standard": SpectralModel(G_e=0.0, G_s=1.0, G_a=1.06),
    "white noise slope": SpectralModel(G_e=0.0, G_s=1.0, G_a=0.0),
    "choppy": SpectralModel(G_e=0.08, G_s=1.0, G_a=0.0),
}
"""Table 2.3: four cases for analysis, for a white noise slope of one."""


def power_law(nu: float, G_nu_0: float, nu_0: float, w: float) -> float:
    """Evaluate the elevation spectrum that the ISO recommends for fitting.

    Equation:
        (2.1) G(ν) = G(ν_0) (ν/ν_0)^-w

    Args:
        nu: wave number ν, cycle/m.
        G_nu_0: spectral density at the reference wave number, m³/cycle.
        nu_0: reference wave number ν_0, cycle/m.
        w: exponent, dimensionless.

    Returns:
        G(ν), m³/cycle.
    """
    return G_nu_0 * math.pow(nu / nu_0, -w)


def constant_slope_spectrum(G_nu_0: float, nu_0: float) -> float:
    """Evaluate the slope spectrum of the power law with w = 2.

    Equation:
        (2.2) G'(ν) = (2π ν_0)² G(ν_0) = G_s

    Args:
        G_nu_0: spectral density at the reference wave number, m³/cycle.
        nu_0: reference wave number ν_0, cycle/m.

    Returns:
        G_s, m/cycle, at every wave number.
    """
    return (2 * math.pi * nu_0) ** 2 * G_nu_0


def la_barre_slope_spectrum(nu: float, G_0: float, nu_0: float) -> float:
    """Evaluate La Barre's slope spectrum.

    Equation:
        (2.3) G'(ν) = G_0 (1 + (ν_0/ν)²)

    Args:
        nu: wave number ν, cycle/m.
        G_0: white noise slope, m/cycle.
        nu_0: break point ν_0, cycle/m.

    Returns:
        G'(ν), m/cycle.
    """
    return G_0 * (1 + (nu_0 / nu) ** 2)


def elevation_spectrum(nu: float, road: SpectralModel) -> float:
    """Evaluate Sayers' elevation spectrum.

    Equation:
        (2.4) G(ν) = G_e + G_s/(2πν)² + G_a/(2πν)⁴

    Args:
        nu: wave number ν, cycle/m.
        road: coefficients.

    Returns:
        G(ν), m³/cycle.
    """
    omega = 2 * math.pi * nu
    return road.G_e + road.G_s / omega**2 + road.G_a / omega**4


def slope_spectrum(nu: float, road: SpectralModel) -> float:
    """Evaluate Sayers' slope spectrum.

    Equation:
        (2.5) G'(ν) = G_e/(2πν)^-2 + G_s + G_a/(2πν)²

    Args:
        nu: wave number ν, cycle/m.
        road: coefficients.

    Returns:
        G'(ν), m/cycle.
    """
    omega = 2 * math.pi * nu
    return road.G_e / omega**-2 + road.G_s + road.G_a / omega**2


def acceleration_to_slope_ratio(nu_0: float) -> float:
    """Express La Barre's break point by Sayers' coefficients.

    Equation:
        (2.6) G_a/G_s = (2π ν_0)²

    Args:
        nu_0: break point ν_0, cycle/m.

    Returns:
        G_a/G_s, 1/m².
    """
    return (2 * math.pi * nu_0) ** 2
