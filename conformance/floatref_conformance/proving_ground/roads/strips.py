"""The road beside a wheel path: parallel strings, long waves coherent with it, short ones less.

Measured on a Belgian block (``belgian_block.crg`` of OpenCRG, 10 m by 3.4 m, every 1 cm), the slope
between neighbouring points along the road correlates across it by 0.934 at 1 cm, 0.677 at 5 cm,
0.560 at 10 cm and 0.336 at 50 cm. With `lateral_coherence` the same differences of a road of white
slope correlate by 0.915, 0.696, 0.559 and 0.341.

Each wave of wave number ν falls off sideways by exp(-2πνy/a), which makes a surface without a
scale of its own, as a road of white slope is. A large ``a`` means features that are long across
the road. The exponential makes each string follow from the one beside it alone, so that strings are
drawn outwards as far as a line needs them.

Print's agreement at a lateral separation follows without being fitted. Profiles of six roads of
table 2.2's normal case, filtered as for the IRI, agree by 0.987 at 3 cm (lowest 0.975), by 0.984
at 5 cm and by 0.966 at 14 cm. In print 14 pairs of passes 3 cm apart or less agree above 0.98 but
for one (0.976), a pair 5.2 cm apart by 0.993 (4.5.3), and passes 14 cm off the reference by 0.949
(4.5.2), which holds the errors of both devices.

The wheel paths themselves keep the coherence of `random_roads`, and every string its wheel path's
spectrum.
"""

from collections.abc import Iterator
from itertools import count
from zlib import crc32

import numpy as np
from scipy.fft import dct, idct, next_fast_len

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M, LEVEL_UNTIL_M, Road
from floatref_conformance.proving_ground.roads.shaping import cosine_rise
from floatref_conformance.proving_ground.roads.surface import Surface
from floatref_conformance.proving_ground.roads.wander import Line

ACROSS_M = 0.01
"""Distance between strings in m, the grid of the measured surface."""
NARROW_SHARE, NARROW = 0.7, 13.0
"""Share of the variance, and elongation ``a``, of what is narrow across the road; fitted to the
four measured correlations, of which they miss each by at most 0.02."""
WIDE = 1100.0
"""Elongation of the remaining share: joints and rows of stones, fitted with the others."""
REACH_M = 0.4


def lateral_coherence(wave_number: FloatArray, apart_m: float) -> FloatArray:
    """Return the coherence of strings ``apart_m`` apart at wave numbers in cycles/m."""
    phase = 2 * np.pi * np.asarray(wave_number, dtype=np.float64) * abs(apart_m)
    return NARROW_SHARE * np.exp(-phase / NARROW) + (1 - NARROW_SHARE) * np.exp(-phase / WIDE)


def strip_around(
    road: Road, track: str, seed: int, right_m: float = -REACH_M, left_m: float = REACH_M
) -> Surface:
    """Return the strings from ``right_m`` to ``left_m`` beside a wheel path, in m.

    Lateral positions of the strip count from the wheel path, left positive; the string at 0 is
    the wheel path bit for bit. The strings are level where a made road is, before
    `LEVEL_UNTIL_M`. A narrower strip of the same road, wheel path and seed has the same strings.

    Raises InputError for a wheel path that the road lacks, or limits out of order.
    """
    if track not in road.elevation:
        raise InputError(f"wheel path {track}: missing; the road has {', '.join(road.tracks)}")
    if not (np.isfinite([right_m, left_m]).all() and right_m <= left_m):
        raise InputError(f"a strip from {right_m} to {left_m} m: give the right limit first")
    first = int(np.floor(right_m / ACROSS_M))
    last = max(int(np.ceil(left_m / ACROSS_M)), first + 1)
    rows = np.empty((last - first + 1, road.points))
    path, fade = road.elevation[track], _fade(road)
    for side, outermost in ((1, last), (-1, -first)):
        strings = _differences(road, track, seed, side)
        for step in range(1, outermost + 1):
            amplitudes = next(strings)
            if first <= side * step <= last:
                rows[side * step - first] = path + _difference(road, amplitudes, fade)
    if first <= 0 <= last:
        rows[-first] = path
    return Surface(road.start_m, road.spacing_m, ACROSS_M * first, ACROSS_M, rows)


def along_line(road: Road, line: Line, seed: int) -> Road:
    """Return the road under a line: every wheel path shifted alike into its own strip.

    ``seed`` draws the strips: passes on one road share it. Raises InputError as `Line.at` does.
    """
    y = line.at(road.distance_m)
    reach = float(y.min()), float(y.max())
    return road.with_elevation(
        {track: strip_around(road, track, seed, *reach).line(y) for track in road.tracks}
    )


def _first_full(road: Road) -> int:
    """Return the first point from which on a made road carries its whole roughness."""
    first = int(np.searchsorted(road.distance_m, FULL_FROM_M))
    return first if first < road.points - 1 else 0


def _differences(road: Road, track: str, seed: int, side: int) -> Iterator[FloatArray]:
    """Yield what strings differ by from the wheel path, outwards, as amplitudes of cosines.

    Cosines of half a period and its multiples over the whole roughness stand for the road's
    waves, so that no end has to meet the other one.
    """
    z = road.elevation[track][_first_full(road) :]
    padded = np.pad(z, (0, next_fast_len(z.size, real=True) - z.size), mode="edge")
    middle = dct(padded, norm="ortho")
    size, sign = np.abs(middle), np.where(middle < 0, -1.0, 1.0)
    phase = np.pi * np.arange(middle.size) / (middle.size * road.spacing_m) * ACROSS_M
    keeps = np.exp(-phase / NARROW), np.exp(-phase / WIDE)
    fresh = [
        np.sqrt(share * (1 - keep**2))
        for share, keep in zip((NARROW_SHARE, 1 - NARROW_SHARE), keeps, strict=True)
    ]
    # Both components of the middle string add up to it; both sides share them.
    shared = _stream(seed, track, 0).standard_normal(middle.size)
    narrow = NARROW_SHARE * sign + np.sqrt(NARROW_SHARE * (1 - NARROW_SHARE)) * shared
    wide = sign - narrow
    rng = _stream(seed, track, side)
    drawn = np.empty(middle.size)
    for _ in count():
        for part, keep, new in zip((narrow, wide), keeps, fresh, strict=True):
            rng.standard_normal(out=drawn)
            drawn *= new
            part *= keep
            part += drawn
        yield size * (narrow + wide - sign)


def _fade(road: Road) -> FloatArray:
    """Return the share of a difference before the road carries its whole roughness."""
    x = road.distance_m[: _first_full(road)]
    return cosine_rise((x - LEVEL_UNTIL_M) / (FULL_FROM_M - LEVEL_UNTIL_M))


def _difference(road: Road, amplitudes: FloatArray, fade: FloatArray) -> FloatArray:
    """Return the difference in m of a string of these amplitudes, faded in as the road is."""
    full = idct(amplitudes, norm="ortho")[: road.points - fade.size]
    before = full[np.minimum(np.arange(fade.size)[::-1], full.size - 1)]
    return np.concatenate([fade * before, full])


def _stream(seed: int, track: str, side: int) -> np.random.Generator:
    """Return the generator of one side of one wheel path, of the middle for side 0."""
    key = (crc32(b"strip"), crc32(track.encode()), side + 1)
    return np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=key)))
