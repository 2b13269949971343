"""The zero-phase sets give each kernel one type of road, so that it is compiled once."""

import numba
import numpy as np
import pytest

from floatref.measures.roughness import zero_phase
from floatref.values.arrays import read_only

KERNELS = ("high_pass_1", "high_pass_2", "high_pass_21", "low_pass_1", "low_pass_2")


@pytest.mark.parametrize("passed", [zero_phase.high_pass_b3x2, zero_phase.low_pass_b3x2])
def test_a_road_that_may_be_written_and_one_that_may_not_share_the_kernels(passed, monkeypatch):
    given = {name: set() for name in KERNELS}

    def record(name):
        kernel = getattr(zero_phase, name)

        def call(road, *others):
            given[name].add(numba.typeof(road))
            kernel(road, *others)

        monkeypatch.setattr(zero_phase, name, call)

    for name in KERNELS:
        record(name)
    road = np.random.default_rng(4).normal(size=500)
    fixed = passed(read_only(road), 0.1, 5.0)
    assert np.array_equal(passed(road, 0.1, 5.0), fixed)
    assert max(map(len, given.values())) == 1
