"""Roughness of a lane from its two wheel paths: MRI, HRI and the Ride Number.

The mean roughness index is the mean of two IRIs, `mean_roughness_index`. The half-car roughness
index is the IRI of the mean of two profiles: a car whose axle is held level follows that mean.
The Ride Number is a scale from 0 to 5 of how passengers rate a ride.
"""

import math

import numpy as np

from floatref.errors import InputError
from floatref.measures.gaps import check_elevation
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.quarter_car import RIDE_NUMBER_CAR
from floatref.measures.roughness.roughness_index import M_PER_KM, STANDARD, iri, iri_trace
from floatref.values.arrays import FloatArray
from floatref.values.scanning import chunks

HIGHEST_RIDE_NUMBER = 5.0
"""Ride Number of a road without any roughness."""
RIDE_NUMBER_DECAY = 160.0
"""Factor of the profile index in the exponent of the Ride Number."""


def mean_path(left: FloatArray, right: FloatArray, interval_m: float) -> FloatArray:
    """Return the mean elevation in m of two wheel paths, NaN where either is NaN.

    Raises InputError unless both have the same length and can be used at ``interval_m``.
    """
    one, other = check_elevation(left, interval_m), check_elevation(right, interval_m)
    if one.shape != other.shape:
        raise InputError(
            f"wheel paths of {one.size} and {other.size} points; cut them to the same points"
        )
    mean = np.empty(one.size)
    for (at, part), (_, beside) in zip(chunks(one), chunks(other), strict=True):
        mean[at : at + part.size] = (part + beside) / 2.0
    return mean


def half_car_roughness_index(
    left: FloatArray, right: FloatArray, interval_m: float, settings: IriSettings = STANDARD
) -> float:
    """Return the HRI in m/km: the IRI of the mean of elevations ``left`` and ``right`` in m.

    It is never above the mean roughness index of the two. Raises InputError as `mean_path` and
    `iri`. Source: M. W. Sayers, Two Quarter-Car Models for Defining Road Roughness: IRI and HRI,
    Transportation Research Record 1215, 1989.
    """
    return iri(mean_path(left, right, interval_m), interval_m, settings)


def ride_profile_index(
    elevation: FloatArray, interval_m: float, settings: IriSettings = STANDARD
) -> float:
    """Return the profile index PI in m/m of one wheel path, from which a Ride Number follows.

    PI = √(Σ y²/N), y the stroke of steps 1 to 3 of the IRI with K1 = 5120 1/s², K2 = 390 1/s², C =
    17 1/s and μ = 0.036. Elevation in m; missing points are bridged. Raises InputError as `iri`.
    Source: M. W. Sayers and S. M. Karamihas, The Little Book of Profiling, 1998, whose algorithm is
    that of ASTM E1489; the constants are in Karamihas 2021, 2.1.4.
    """
    trace = iri_trace(elevation, interval_m, settings, RIDE_NUMBER_CAR)
    total, count = 0.0, 0
    for _, part in chunks(trace):
        known = part[np.isfinite(part)] / M_PER_KM
        total, count = total + float(np.square(known).sum()), count + known.size
    return math.sqrt(total / count)


def join_profile_indices(left: float, right: float) -> float:
    """Return the profile index of a lane, √((PI_left² + PI_right²)/2), in the unit of both."""
    return math.sqrt((left * left + right * right) / 2.0)


def ride_number(profile_index: float) -> float:
    """Return the Ride Number of ``profile_index`` in m/m: RN = 5 exp(−160 PI), 5 at 0.

    Raises InputError for an index below zero. Source: as `ride_profile_index`.
    """
    if profile_index < 0.0:
        raise InputError(f"profile index is {profile_index:g} m/m; give one of zero or more")
    return HIGHEST_RIDE_NUMBER * math.exp(-RIDE_NUMBER_DECAY * profile_index)
