"""How much of a road lies in a band of wavelengths: RMS elevation and RMS slope.

The bands and their filters are those of 2.1.5.2 of Karamihas 2021: HPF_B3x2 at the longest
wavelength, LPF_B3x2 at the shortest, both without phase shift. At either limit half is left.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.measures.roughness.areas import share, valid_points
from floatref.measures.roughness.gaps import bridge, check_elevation, measured_stretch
from floatref.measures.roughness.wavebands import Waveband, pass_band
from floatref.values.arrays import FloatArray

CONTINUED = 3
"""Longest wavelengths by which a profile is continued: of a run-in e^-3π, 1e-4, is left then."""


@dataclass(frozen=True)
class WavebandEnergy:
    """RMS elevation in m and RMS slope in m/m of a wheel path between two wavelengths in m.

    ``valid_share`` is the share, 0 to 1, of the points from the first to the last measured one that
    are valid.
    """

    long_m: float
    short_m: float
    rms_elevation_m: float
    rms_slope: float
    valid_share: float


def waveband_elevation(elevation: FloatArray, interval_m: float, band: Waveband) -> FloatArray:
    """Return ``elevation`` in ``band``, both in m, from the first to the last measured point.

    The line through these two points is taken off, and the rest is continued on both sides
    by its reflection in them, by three times the longest wavelength, which keeps the run-in of the
    filters outside. Gaps are bridged. The low-pass is not applied where its cut-off is not above
    two intervals. Raises InputError for elevations that cannot be used, for a band whose shortest
    wavelength is not above zero and below the longest one, and for a longest one that is not above
    two intervals. Source: appendix A.1 and 2.1.5.2.
    """
    values = check_elevation(elevation, interval_m)
    _check_band(band, interval_m)
    measured = bridge(values[measured_stretch(values)])
    if measured.size < 2:
        raise InputError("1 point of the profile was measured; a band of wavelengths needs two")
    line = np.linspace(measured[0], measured[-1], measured.size)
    margin = int(np.ceil(CONTINUED * band.long_m / interval_m))
    # Beyond the ends the reflection in a point changes the sign of what is zero there.
    continued = np.pad(measured - line, margin, mode="reflect", reflect_type="odd")
    return pass_band(continued, interval_m, band)[margin : margin + measured.size]


def waveband_energy(
    elevation: FloatArray,
    interval_m: float,
    band: Waveband,
    valid: ArrayLike | None = None,
) -> WavebandEnergy:
    """Return RMS elevation and RMS slope of ``elevation`` in m in ``band``.

    √(Σ z_k²/N) of the N points of `waveband_elevation`, and √(Σ s_k²/(N − 1)) of their slopes
    s_k = (z_{k+1} − z_k)/interval. Without ``valid``, finite points are valid. Raises InputError as
    `waveband_elevation`.
    """
    inside = waveband_elevation(elevation, interval_m, band)
    slope = np.diff(inside) / interval_m
    points = np.asarray(elevation, dtype=np.float64)
    sound = valid_points(valid, points)[measured_stretch(points)]
    rms_elevation, rms_slope = (float(np.sqrt(np.mean(np.square(x)))) for x in (inside, slope))
    return WavebandEnergy(band.long_m, band.short_m, rms_elevation, rms_slope, share(sound))


def _check_band(band: Waveband, interval_m: float) -> None:
    """Raise InputError unless a profile at ``interval_m`` holds ``band``."""
    if not (np.isfinite(band).all() and 0.0 < band.short_m < band.long_m):
        raise InputError(
            f"band from {band.long_m:g} m to {band.short_m:g} m; "
            "give its longest wavelength in m, then its shortest one, both above zero"
        )
    if not band.long_m > 2.0 * interval_m:
        raise InputError(
            f"a profile at {interval_m:g} m holds no wavelengths of {band.long_m:g} m; "
            "take a longer wavelength or a finer profile"
        )
