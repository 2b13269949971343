"""Filters for the content to compare, and the agreement in a band (2.1.5.2)."""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.kernels.cut_off import high_pass_wavelength_setting
from floatref.measures.gaps import bridge, check_elevation, measured_stretch
from floatref.measures.roughness.agreement import Agreement, cross_correlation
from floatref.measures.roughness.roughness_index import iri_trace
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.display.similar_names import suggest
from floatref.values.scanning import chunks


class Waveband(NamedTuple):
    """Cut-off wavelengths λc in m of the third-order passes of HPF_B3x2 and LPF_B3x2."""

    long_m: float
    short_m: float


WAVEBANDS: Mapping[str, Waveband] = MappingProxyType(
    {
        "long": Waveband(65.6, 8.0),
        "medium": Waveband(8.0, 1.6),
        "short": Waveband(1.6, 0.14),
    }
)
"""The three diagnostic wavebands of 2.1.5.2."""

BANDS = ("iri", *WAVEBANDS)
"""What `agreement` can filter for: the output of the IRI filter, or one waveband."""


def high_pass(elevation: FloatArray, interval_m: float, wavelength_m: float = 91.44) -> FloatArray:
    """Return HPF_B3x2 of ``elevation``, −3 dB at ``wavelength_m``, without phase shift.

    Elevation counts from the first measured point, as a floating reference height does, so the
    datum does not change the filter's run-in. Same length; NaN before the first and after the last
    measured point and, after the bridge has been filtered, in gaps again. Raises InputError for a
    wavelength of two intervals or less. Source: appendix A.1, A.5 and (A.22).
    """
    from floatref.measures.roughness.zero_phase import high_pass_b3x2

    values = check_elevation(elevation, interval_m)
    _check_cutoff(wavelength_m, interval_m)
    stretch = measured_stretch(values)
    filtered = np.full(values.size, np.nan)
    cutoff = high_pass_wavelength_setting(wavelength_m)
    rise = bridge(values[stretch]) - values[stretch.start]
    filtered[stretch] = high_pass_b3x2(rise, interval_m, cutoff)
    filtered[~np.isfinite(values)] = np.nan
    return filtered


def waveband_slope(
    elevation: FloatArray, interval_m: float, band: str, mean_slope: float | None = None
) -> FloatArray:
    """Return the slope in m/m of ``elevation`` in ``band``, one value fewer than points.

    The slope less its mean is continued at both ends by its mirror image, as far as the band's
    longest wavelength, which keeps the run-in of the filters outside. Of a piece of a road
    ``mean_slope`` is that of the whole road, in m/m; else it is that of ``elevation``. Gaps are
    bridged; ends without elevation are refused. The low-pass is not applied where its cut-off is
    not above two intervals: the profile holds nothing shorter. Raises InputError for an unknown
    band or one whose long end is not above two intervals. Source: 2.1.5.2.
    """
    if band not in WAVEBANDS:
        raise InputError(f"band {band!r}: unknown; {suggest(band, BANDS, 'known:')}")
    limits = WAVEBANDS[band]
    _check_cutoff(limits.long_m, interval_m)
    values = check_elevation(elevation, interval_m)
    if not np.isfinite(values[[0, -1]]).all():
        raise InputError("elevation starts or ends with NaN; cut the profile to what was measured")
    margin = math.ceil(limits.long_m / interval_m)
    continued = _continue(bridge(values), interval_m, margin, mean_slope)
    return pass_band(continued, interval_m, limits)[margin : margin + values.size - 1]


def _continue(
    elevation: FloatArray, interval_m: float, margin: int, mean_slope: float | None
) -> FloatArray:
    """Return the slope of ``elevation`` less its mean, mirrored for ``margin`` at both ends."""
    continued = np.empty(elevation.size - 1 + 2 * margin)
    slope = continued[margin : margin + elevation.size - 1]
    for at, part in chunks(elevation, overlap=1):
        slope[at : at + part.size - 1] = np.diff(part) / interval_m
    slope -= slope.mean() if mean_slope is None else mean_slope
    # Of a long road the pieces next to the ends are all that is mirrored.
    before, behind = (
        np.pad(part, margin, mode="symmetric") for part in (slope[:margin], slope[-margin:])
    )
    continued[:margin], continued[margin + slope.size :] = before[:margin], behind[-margin:]
    return continued


def agreement(
    p: FloatArray,
    q: FloatArray,
    interval_m: float,
    band: str = "iri",
    max_offset_m: float = 1.0,
) -> Agreement:
    """Return the agreement of elevation ``q`` with ``p`` in m, both on the same points.

    Both are cut to the stretch that both measured, gaps inside are bridged, then both are
    filtered: ``band`` is "iri" (steps 1 to 3 of the IRI), "long", "medium" or "short". An
    offset above zero says that ``q`` lies farther along. Raises InputError where the two share
    no stretch, as `cross_correlation` and the filters do. Source: 2.1.5.
    """
    p, q = check_elevation(p, interval_m), check_elevation(q, interval_m)
    if p.shape != q.shape:
        raise InputError(f"profiles of {p.size} and {q.size} points; cut them to the same points")
    common = common_stretch(np.isfinite(p) & np.isfinite(q))
    p_band, q_band = (band_signal(z[common], interval_m, band) for z in (p, q))
    return cross_correlation(p_band, q_band, interval_m, max_offset_m)


def pass_band(slope: FloatArray, interval_m: float, limits: Waveband) -> FloatArray:
    """Return ``slope``, which it overwrites, through HPF_B3x2 and, where it can act, LPF_B3x2."""
    from floatref.measures.roughness.zero_phase import high_pass_b3x2, low_pass_b3x2

    passed = high_pass_b3x2(slope, interval_m, limits.long_m, out=slope)
    if limits.short_m <= 2 * interval_m:
        return passed
    return low_pass_b3x2(passed, interval_m, limits.short_m, out=passed)


def band_signal(
    elevation: FloatArray, interval_m: float, band: str, mean_slope: float | None = None
) -> FloatArray:
    """Return ``elevation`` in m through the filter of ``band``, one value fewer than points.

    This is what `agreement` correlates: of a stretch that both profiles measured. ``mean_slope`` is
    that of `waveband_slope`. Raises InputError as the filters do.
    """
    if band == "iri":
        signal = iri_trace(elevation, interval_m)
    else:
        signal = waveband_slope(elevation, interval_m, band, mean_slope)
    # What was read of a file would stay in memory.
    release(elevation)
    return signal


def common_stretch(both: BoolArray) -> slice:
    """Return the longest stretch at whose ends ``both`` is true.

    Raises InputError where that is at fewer than two points.
    """
    if np.count_nonzero(both) < 2:
        raise InputError("the two profiles share no two measured points; nothing to compare")
    return slice(int(both.argmax()), both.size - int(both[::-1].argmax()))


def _check_cutoff(wavelength_m: float, interval_m: float) -> None:
    """Raise InputError unless a profile at ``interval_m`` holds ``wavelength_m``."""
    if not wavelength_m > 2 * interval_m:
        raise InputError(
            f"a profile at {interval_m:g} m holds no wavelengths of {wavelength_m:g} m; "
            "take a longer wavelength or a finer profile"
        )
