"""A lane of two wheel paths: MRI, HRI and Ride Number."""

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_1_golden_car import suspension_stroke
from floatref_reference.chapter_2.section_2_1_1_iri import (
    iri,
    moving_average,
    slope,
    start_slope,
)
from floatref_reference.chapter_2.section_2_1_4_waveband import RIDE_NUMBER_CAR
from floatref_reference.signals import ZERO, Real, Signal, samples, signal


def mean_path(left: npt.ArrayLike, right: npt.ArrayLike) -> Signal:
    """Average two wheel paths.

    Equation:
        z(x_k) = (z_left(x_k) + z_right(x_k)) / 2

    Args:
        left: elevation, m, shape (N,).
        right: elevation, m, shape (N,).

    Returns:
        Mean elevation, m, shape (N,).
    """
    return signal([(a + b) / 2 for a, b in zip(samples(left), samples(right), strict=True)])


def mean_roughness_index(left: npt.ArrayLike, right: npt.ArrayLike, dx: float) -> np.longdouble:
    """Compute the MRI.

    Equation:
        AASHTO R 43: MRI = (IRI_left + IRI_right) / 2

    Args:
        left: elevation, m, shape (N,).
        right: elevation, m, shape (N,).
        dx: constant interval Δx, m.

    Returns:
        MRI, m/km.
    """
    return (iri(left, dx) + iri(right, dx)) / 2


def half_car_roughness_index(left: npt.ArrayLike, right: npt.ArrayLike, dx: float) -> np.longdouble:
    """Compute the HRI.

    Equation:
        Sayers, Two Quarter-Car Models for Defining Road Roughness: IRI and HRI, TRR 1215, 1989: the
        IRI of the mean of both profiles.

    Args:
        left: elevation, m, shape (N,).
        right: elevation, m, shape (N,).
        dx: constant interval Δx, m.

    Returns:
        HRI, m/km.
    """
    return iri(mean_path(left, right), dx)


def profile_index(z: npt.ArrayLike, dx: float) -> np.longdouble:
    """Compute the profile index of a Ride Number.

    Equation: Sayers and Karamihas, The Little Book of Profiling, 1998: steps 1 to 3 of section
    2.1.1 with the car of the Ride Number in place of the Golden Car, then PI = √(Σ y_k² / N).

    Args:
        z: elevation, m, shape (N+1,).
        dx: constant interval Δx, m.

    Returns:
        PI, m/m.
    """
    smoothed = moving_average(slope(z, dx), dx)
    stroke = suspension_stroke(smoothed, dx, start_slope(z, dx), car=RIDE_NUMBER_CAR)
    total = ZERO
    for y in samples(stroke):
        total += y * y
    return np.longdouble(np.sqrt(total / len(stroke)))


def ride_number(*indices: Real) -> np.longdouble:
    """Compute the Ride Number of one wheel path or of two.

    Equation:
        Sayers and Karamihas 1998: RN = 5 exp(-160 PI), and of two wheel paths
        PI = √((PI_left² + PI_right²) / 2).

    Args:
        indices: profile index of each wheel path, m/m.

    Returns:
        RN, 0 to 5.
    """
    squares = [np.longdouble(index) ** 2 for index in indices]
    return np.longdouble(5 * np.exp(-160 * np.sqrt(sum(squares, ZERO) / len(squares))))
