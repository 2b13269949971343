"""Joints and patches give a slope its heavy tail, and nothing else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.roads.distress import (
    LONGEST_PATCH_M,
    kurtosis_of_slope,
    with_joints,
    with_patches,
)
from floatref_conformance.proving_ground.roads.random_roads import sayers_road
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M, flat_road

SEEDS = st.integers(0, 2**32 - 1)


@settings(max_examples=20)
@given(seed=SEEDS, spacing=st.floats(2.0, 20.0), fault=st.floats(1e-4, 1e-2))
def test_a_slab_is_level_and_ends_at_its_joint(seed, spacing, fault):
    road = with_joints(flat_road(300.0, spacing_m=0.05), spacing, fault, seed)
    x = road.distance_m
    for z in road.elevation.values():
        assert not z[x < FULL_FROM_M].any()
        steps = np.flatnonzero(np.diff(z))
        joint = (x[steps + 1] - FULL_FROM_M) / spacing
        assert (np.abs(joint - np.floor(joint)) * spacing <= 0.05 + 1e-9).all()
        assert steps.size == int((x[-1] - FULL_FROM_M) / spacing) + 1


def test_steps_have_their_size_and_their_correlation():
    road = with_joints(flat_road(40e3, spacing_m=1.0), 4.0, 3e-3, 7)
    left, right = (np.diff(road.elevation[name][46::4]) for name in ("left", "right"))
    assert np.std(left) == pytest.approx(3e-3, rel=0.05)
    assert np.corrcoef(left, right)[0, 1] == pytest.approx(0.7, abs=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_a_concrete_motorway_has_the_kurtosis_that_was_measured(seed):
    """Nine runs on one: 800 to 1550, with a spectrum of the slope that is about white.

    Slabs of 4.6 m in steps of 25 mm have a kurtosis of 3·184 if nothing else is rough; 100 times as
    many points as joints need the finer grid of the measurement, 5 mm.
    """
    plain = sayers_road("normal", 1000.0, seed)
    smooth = plain.with_elevation({n: 0.1 * z for n, z in plain.elevation.items()})
    road = with_joints(smooth, 4.6, 3e-3, seed)
    z = road.elevation["left"][road.distance_m > FULL_FROM_M]
    assert kurtosis_of_slope(plain.elevation["left"]) < 5.0
    assert 500.0 < kurtosis_of_slope(z) < 4000.0
    power = np.abs(np.fft.rfft(np.diff(z))) ** 2
    low, high = (part.mean() for part in np.array_split(power[1:], 2))
    assert 0.7 < low / high < 1.4


@pytest.mark.slow
@settings(max_examples=20)
@given(seed=SEEDS, per_km=st.floats(1.0, 100.0))
def test_patches_are_as_many_as_stated_and_level_on_top(seed, per_km):
    road = with_patches(flat_road(5000.0, spacing_m=0.1), per_km, 0.02, seed)
    expected = per_km * (road.end_m - FULL_FROM_M) / 1000
    for z in road.elevation.values():
        edges = np.count_nonzero(np.diff(z))
        # Patches that overlap or are cut by the end share edges.
        assert edges <= 2 * (expected + 6 * np.sqrt(expected) + 2)
        covered = np.count_nonzero(z) * 0.1
        assert covered <= (expected + 6 * np.sqrt(expected) + 2) * LONGEST_PATCH_M


@pytest.mark.parametrize("spacing", [0.0, -1.0, float("nan")])
def test_slabs_without_length_are_refused(spacing):
    with pytest.raises(InputError, match="joint_spacing_m"):
        with_joints(flat_road(100.0), spacing, 1e-3, 0)
