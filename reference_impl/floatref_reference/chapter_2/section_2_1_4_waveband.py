"""2.1.4 Waveband of Interest: frequency response (2.1.4.2) and wavelength thresholds (2.1.4.3)."""

import math
from typing import NamedTuple

import numpy as np

from floatref_reference.chapter_2.section_2_1_1_golden_car import GOLDEN_CAR, QuarterCar
from floatref_reference.chapter_2.section_2_1_4_1_spectral_models import (
    SpectralModel,
    slope_spectrum,
)
from floatref_reference.signals import ZERO

LAMBDA_MIN = 0.01
LAMBDA_MAX = 10_000.0
STEPS = 20_000


class Index(NamedTuple):
    """A profile-based roughness index as a linear filter.

    Args:
        car: constants of the quarter car.
        V: simulated speed, km/h.
        B: base length of the moving average, m.
    """

    car: QuarterCar
    V: float
    B: float = 0.25


RIDE_NUMBER_CAR = QuarterCar(K_1=5120.0, K_2=390.0, C=17.0, mu=0.036)

INDICES = {
    "IRI": Index(GOLDEN_CAR, V=80.0),
    "GCARS_120": Index(GOLDEN_CAR, V=120.0),
    "GCARS_40": Index(GOLDEN_CAR, V=40.0),
    "PTRN": Index(RIDE_NUMBER_CAR, V=80.0),
}


def wave_number(wavelength: float) -> float:
    """Convert a wavelength to a wave number.

    Equation:
        (2.8) ν = 1/λ

    Args:
        wavelength: λ, m.

    Returns:
        ν, cycle/m.
    """
    return 1 / wavelength


def h_moving_average(nu: float, B: float) -> float:
    """Evaluate the transfer function of the moving average.

    Equation:
        (2.7) H_MA(ν) = sin(π B ν) / (π B ν)

    Args:
        nu: wave number ν, cycle/m.
        B: base length, m; 0 for no moving average.

    Returns:
        H_MA, dimensionless.
    """
    angle = math.pi * B * nu
    return math.sin(angle) / angle if angle else 1.0


def denominator(omega: float, car: QuarterCar) -> complex:
    """Evaluate the denominator of the quarter car's transfer function.

    Equation:
        (2.10), with the sign of its damping term mended, which prints as a plus:
        D = μ ω⁴ - (K_1 + K_2 (1 + μ)) ω² + K_1 K_2 + j C ω (K_1 - ω² (1 + μ))

    Args:
        omega: angular frequency ω, rad/s.
        car: constants of the quarter car.

    Returns:
        D, 1/s⁴.
    """
    K_1, K_2, C, mu = car
    real = mu * omega**4 - (K_1 + K_2 * (1 + mu)) * omega**2 + K_1 * K_2
    return real + 1j * C * omega * (K_1 - omega**2 * (1 + mu))


def h_suspension_stroke(nu: float, index: Index) -> complex:
    """Evaluate the quarter car's transfer function from slope to suspension stroke.

    Equation:
        (2.9) H_GCSS(ω = 2πνV) = K_1 ω² / D. The phase is that of z_s' - z_u'.

    Args:
        nu: wave number ν, cycle/m.
        index: quarter car and speed V.

    Returns:
        H_GCSS, dimensionless.
    """
    omega = 2 * math.pi * nu * index.V / 3.6
    return index.car.K_1 * omega**2 / denominator(omega, index.car)


def output_spectrum(nu: float, index: Index, road: SpectralModel) -> float:
    """Evaluate the spectrum of the signal that the index averages.

    Equation:
        (2.11) G_IRI(ν) = |H_MA(ν)|² |H_GCSS(ν)|² G'(ν)

    Args:
        nu: wave number ν, cycle/m.
        index: the roughness index.
        road: spectral model of the road.

    Returns:
        G_IRI, m/cycle.
    """
    gain = h_moving_average(nu, index.B) * abs(h_suspension_stroke(nu, index))
    return gain**2 * slope_spectrum(nu, road)


def captured_portion(index: Index, road: SpectralModel) -> tuple[list[float], list[np.longdouble]]:
    """Accumulate the index from the shortest wavelength up (figure 2.8).

    Equation:
        ∫ G_IRI dν with dν = ν d(ln λ), by the trapezoidal rule on 20 000 equal steps of ln λ
        from 10 mm to 10 km. The content beyond both limits is below 1e-5 of the whole.

    Args:
        index: the roughness index.
        road: spectral model of the road.

    Returns:
        ln λ of each limit (λ in m) and the share of ∫ G_IRI dν at wavelengths up to it, 0 to 1.
    """
    first, last = math.log(LAMBDA_MIN), math.log(LAMBDA_MAX)
    step = (last - first) / STEPS
    ln_lambda = [first + i * step for i in range(STEPS + 1)]
    cumulative = [ZERO]
    before = ZERO
    for i, exponent in enumerate(ln_lambda):
        nu = wave_number(math.exp(exponent))
        now = np.longdouble(output_spectrum(nu, index, road) * nu)
        if i > 0:
            cumulative.append(cumulative[-1] + (before + now) / 2 * step)
        before = now
    return ln_lambda, [part / cumulative[-1] for part in cumulative]


def wavelength_thresholds(
    index: Index, road: SpectralModel, capture: float = 0.995
) -> tuple[float, float]:
    """Find the wavelengths that bound the content of an index.

    Equation:
        Section 2.1.4.3: the index over part of the waveband is the square root of its share
        of ∫ G_IRI dν. The long threshold is the λ up to which 99.5 percent of the index
        accumulates, the short one the λ down to which it does (Tables 2.4 to 2.6).

    Args:
        index: the roughness index.
        road: spectral model of the road.
        capture: portion of the index to capture.

    Returns:
        Long and short threshold, m.
    """
    ln_lambda, share = captured_portion(index, road)
    long = np.interp(capture**2, share, ln_lambda)
    short = np.interp(1 - capture**2, share, ln_lambda)
    return math.exp(long), math.exp(short)
