"""A road from a measured profile.

The profile is resampled by a cubic spline and starts where the made road carries its whole
roughness. Before and beyond its ends it is mirrored through its end points, which keeps
elevation and slope continuous, so that it can be made to any length.
"""

from collections.abc import Mapping, Sequence
from importlib.resources import files

import numpy as np
from scipy.interpolate import CubicSpline

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.random_roads import coherence
from floatref_conformance.proving_ground.roads.road import (
    FULL_FROM_M,
    SPACING_M,
    START_M,
    Road,
    lateral_positions,
    points_of,
)
from floatref_conformance.proving_ground.roads.shaping import with_level_start

SHIPPED_INTERVAL_M = 0.25
"""Interval of the profile that `shipped_profile` returns, in m."""


def shipped_profile() -> FloatArray:
    """Return 544 m of a road measured by Sorel and Sroubek, elevation in m every 0.25 m.

    Its IRI is 3.33 m/km; ``data/sroubek`` holds its source and licence (MIT).
    """
    data = files("floatref_conformance.proving_ground") / "data" / "sroubek" / "profile_1.txt"
    rows = [line.split() for line in data.read_text(encoding="utf-8").splitlines()]
    return np.array([float(elevation) for _, elevation in rows])


def measured_road(
    elevation: FloatArray | Mapping[str, FloatArray],
    interval_m: float,
    length_m: float | None = None,
    seed: int = 0,
    spacing_m: float = SPACING_M,
    tracks: Sequence[str] | Mapping[str, float] = ("left", "right"),
    start_m: float = START_M,
) -> Road:
    """Make a road of a measured profile whose first point comes to lie at `FULL_FROM_M`.

    Args:
        elevation: in m, shape (n,), one array or one per wheel path. One array becomes the
            leftmost wheel path; each further one takes its long waves from its neighbour and
            its short waves with random phases, coherent as `spectral.coherence` says.
        interval_m: between the points of the profile, in m.
        length_m: usable length of the road in m; the end of the profile if not given.
        seed: draws the phases of derived wheel paths.
        spacing_m: grid of the road, in m.
        tracks: wheel paths, names or lateral positions in m.
        start_m: where the grid starts, in m.

    Raises:
        InputError: for a profile of fewer than four points, NaN, or unequal lengths.
    """
    sides = lateral_positions(tracks)
    profiles = _per_track(elevation, interval_m, sides, seed)
    points = min(z.size for z in profiles.values())
    length = FULL_FROM_M + interval_m * (points - 1) if length_m is None else length_m
    x = start_m + spacing_m * np.arange(points_of(length, spacing_m, start_m), dtype=np.float64)
    road = Road(
        start_m,
        spacing_m,
        {name: _resample(z, interval_m, x - FULL_FROM_M) for name, z in profiles.items()},
        sides,
    )
    return with_level_start(road)


def _per_track(
    elevation: FloatArray | Mapping[str, FloatArray],
    interval_m: float,
    sides: Mapping[str, float],
    seed: int,
) -> dict[str, FloatArray]:
    """Return one checked profile per wheel path, deriving those that were not measured."""
    if not (np.isfinite(interval_m) and interval_m > 0):
        raise InputError(f"interval_m is {interval_m}; it must be above zero")
    names = sorted(sides, key=lambda name: -sides[name])
    given = elevation if isinstance(elevation, Mapping) else {names[0]: elevation}
    for name, z in given.items():
        if z.ndim != 1 or z.size < 4 or not np.isfinite(z).all():
            raise InputError(f"profile of {name}: needs four or more points, all of them finite")
    if isinstance(elevation, Mapping):
        if set(given) != set(sides) or len({z.size for z in given.values()}) > 1:
            raise InputError("the measured profiles must be as many and as long as the wheel paths")
        return dict(given)
    profiles = dict(given)
    streams = np.random.SeedSequence(seed).spawn(len(names))
    for left, name, stream in zip(names, names[1:], streams, strict=False):
        apart = sides[left] - sides[name]
        profiles[name] = _neighbour(profiles[left], interval_m, apart, stream)
    return profiles


def _neighbour(
    z: FloatArray, interval_m: float, apart_m: float, stream: np.random.SeedSequence
) -> FloatArray:
    """Return a profile of the same spectrum, coherent with ``z`` at long waves only."""
    mirrored = np.concatenate([z, z[::-1]])
    waves = np.fft.rfft(mirrored)
    phases = np.random.default_rng(stream).uniform(0.0, 2 * np.pi, waves.size)
    period_m = mirrored.size * interval_m
    shared = coherence(np.arange(waves.size, dtype=np.float64) / period_m, apart_m)
    mixed = waves * (shared + np.sqrt(1 - shared**2) * np.exp(1j * phases))
    return np.asarray(np.fft.irfft(mixed, mirrored.size)[: z.size])


def _resample(z: FloatArray, interval_m: float, x: FloatArray) -> FloatArray:
    """Return the profile at ``x`` in m from its first point, mirrored beyond its ends."""
    before = max(0, int(np.ceil(-x[0] / interval_m)) + 2)
    after = max(0, int(np.ceil(x[-1] / interval_m)) + 2 - (z.size - 1))
    long = np.pad(z, (before, after), mode="reflect", reflect_type="odd")
    knots = interval_m * (np.arange(long.size) - before)
    return np.asarray(CubicSpline(knots, long)(x))
