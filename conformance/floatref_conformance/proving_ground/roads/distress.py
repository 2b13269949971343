"""Joints, faults and patches: what gives the slope of a road its heavy tail.

A road of a spectrum has a Gaussian slope, of kurtosis 3. Nine measured runs on a concrete motorway
have a kurtosis of 800 to 1550 with a spectrum of the slope that is about white: single steps do
that. A step of height h between points d apart is a slope of h/d at one point in joint spacing /
d, and steps of independent heights have a white slope.
"""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M, Road

SHARED = 0.7
"""Correlation of the steps of both wheel paths: a slab tilts as one, and rocks. No source: ours."""
SHORTEST_PATCH_M, LONGEST_PATCH_M = 0.3, 3.0
"""A utility cut to a repaired lane: lengths between which a patch's is drawn. No source: ours."""


def with_joints(road: Road, spacing_m: float, fault_m: float, seed: int) -> Road:
    """Return the road with a step at every joint of its slabs, from `FULL_FROM_M` on.

    Args:
        road: the road to add them to.
        spacing_m: between joints, in m.
        fault_m: standard deviation of a step, in m, up or down.
        seed: draws the steps of every wheel path, which correlate by `SHARED`.

    Raises:
        InputError: for a spacing that is not above zero.
    """
    if not (np.isfinite(spacing_m) and spacing_m > 0):
        raise InputError(f"joint_spacing_m is {spacing_m}; it must be above zero")
    rng = np.random.default_rng([seed, *b"joints"])
    slab = np.floor((road.distance_m - FULL_FROM_M) / spacing_m).astype(np.int64)
    slab = np.clip(slab, -1, None) + 1
    count = int(slab[-1]) + 1
    shared = rng.standard_normal(count)
    raised = {}
    for name in road.tracks:
        own = rng.standard_normal(count)
        steps = fault_m * (SHARED**0.5 * shared + (1 - SHARED) ** 0.5 * own)
        steps[0] = 0.0
        raised[name] = road.elevation[name] + np.cumsum(steps)[slab]
    return road.with_elevation(raised)


def with_patches(road: Road, per_km: float, height_m: float, seed: int) -> Road:
    """Return the road with rectangular patches in single wheel paths, from `FULL_FROM_M` on.

    Args:
        road: the road to add them to.
        per_km: patches of a wheel path in a kilometre, on average.
        height_m: standard deviation of a patch's height, in m, above or below the road.
        seed: draws place, length and height.
    """
    rng = np.random.default_rng([seed, *b"patches"])
    x = road.distance_m
    patched = {}
    for name in road.tracks:
        count = rng.poisson(max(per_km * (x[-1] - FULL_FROM_M) / 1000, 0.0))
        starts = rng.uniform(FULL_FROM_M, max(x[-1], FULL_FROM_M + 1.0), count)
        lengths = rng.uniform(SHORTEST_PATCH_M, LONGEST_PATCH_M, count)
        heights = height_m * rng.standard_normal(count)
        z = road.elevation[name].copy()
        for start, length, height in zip(starts, lengths, heights, strict=True):
            z[(x >= start) & (x < start + length)] += height
        patched[name] = z
    return road.with_elevation(patched)


def kurtosis_of_slope(elevation: FloatArray) -> float:
    """Return the fourth moment of the differences of ``elevation`` over their variance squared."""
    slope = np.diff(elevation)
    slope = slope - slope.mean()
    return float(np.mean(slope**4) / np.mean(slope**2) ** 2)
