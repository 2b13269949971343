"""How much of a road lies in a band of wavelengths: RMS elevation and RMS slope.

The bands and their filters are those of 2.1.5.2 of Karamihas 2021: HPF_B3x2 at the longest
wavelength, LPF_B3x2 at the shortest, both without phase shift. At either limit half is left.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.measures.gaps import bridge, check_elevation, measured_stretch
from floatref.measures.roughness.areas import share, valid_points
from floatref.measures.roughness.wavebands import Waveband, pass_band
from floatref.values.arrays import FloatArray, release
from floatref.values.scanning import chunks

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
    margin = int(np.ceil(CONTINUED * band.long_m / interval_m))
    count = measured.size
    continued = _continue(measured, margin)
    # What was read of a file, or bridged, would stay in memory.
    release(measured)
    del measured
    return pass_band(continued, interval_m, band)[margin : margin + count]


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
    rms_elevation = _root_mean_square(part for _, part in chunks(inside))
    slopes = (np.diff(part) / interval_m for _, part in chunks(inside, overlap=1))
    rms_slope = _root_mean_square(slopes)
    points = np.asarray(elevation, dtype=np.float64)
    sound = valid_points(valid, points)[measured_stretch(points)]
    release(points)
    return WavebandEnergy(band.long_m, band.short_m, rms_elevation, rms_slope, share(sound))


def _continue(measured: FloatArray, margin: int) -> FloatArray:
    """Return ``measured`` less the line through its ends, with ``margin`` points on both sides.

    Beyond the ends the reflection in a point changes the sign of what is zero there.
    """
    continued = np.empty(measured.size + 2 * margin)
    rest = continued[margin : margin + measured.size]
    step = (measured[-1] - measured[0]) / (measured.size - 1)
    for at, part in chunks(measured):
        line = step * np.arange(at, at + part.size) + measured[0]
        rest[at : at + part.size] = part - line
    rest[-1] = 0.0
    # Of a long road the pieces next to the ends are all that is reflected.
    near = rest[: margin + 1], rest[-margin - 1 :]
    before, behind = (np.pad(part, margin, mode="reflect", reflect_type="odd") for part in near)
    continued[:margin], continued[margin + rest.size :] = before[:margin], behind[-margin:]
    return continued


def _root_mean_square(parts: Iterable[FloatArray]) -> float:
    """Return the root mean square of all values of ``parts``."""
    total, count = 0.0, 0
    for part in parts:
        total, count = total + float(np.square(part).sum()), count + part.size
    return float(np.sqrt(total / count))


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
