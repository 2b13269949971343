"""A seam of a profile in C: the elevation behind a leap goes on at its grade, as in the SDK."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.stages.seams import Seams
from floatref.stages.signals import DISTANCE, HEIGHT, REFERENCE_HEIGHT
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

ENCODER = ChannelId(DISTANCE)
REFERENCE, LASER = ChannelId(REFERENCE_HEIGHT, "main"), ChannelId(HEIGHT, "main")
RATE, POINTS = 1000, 1600


def walk(seed, grade, count=POINTS):
    """Return the elevation of a rough road on a grade."""
    return np.cumsum(np.random.default_rng(seed).normal(grade, 0.003, count))


def of_sdk(elevation, at, by, interval_m):
    """Return samples, one for each interval, of which one is missing before the encoder leaps."""
    place = np.arange(elevation.size) * interval_m
    place[at:] += by * interval_m
    place[at] = np.nan
    values = {ENCODER: place, REFERENCE: elevation, LASER: np.zeros(elevation.size)}
    stage = Seams()
    stage.start(Header(Axis.TIME, 1 / RATE, 0.0, Fraction(RATE), frozenset(values), ("main",)))
    return np.delete(stage.push(Block(0, values))[REFERENCE], at)


def of_c(library, elevation, last, behind, config):
    """Return the status and the points, with a leap to point ``behind`` after ``last``."""
    points = library.array(elevation)
    status = library.lib.fr_seam(config, last, behind, library.at(points), points.size)
    return status, points


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    cell=st.integers(1, 150),
    by=st.integers(5, 500),
    interval_m=st.sampled_from([2.0**-2, 2.0**-3, 2.0**-5]),
    grade=st.floats(-1e-2, 1e-2),
)
@example(seed=1, cell=1, by=5, interval_m=0.25, grade=0.0)
def test_points_behind_are_moved_as_by_the_sdk(double, seed, cell, by, interval_m, grade):
    last = round(cell * 0.25 / interval_m)
    road = walk(seed, grade)
    sdk = of_sdk(road, last + 1, by, interval_m)
    between = np.full(by + 1, 99.0)
    given_points = np.concatenate((road[: last + 1], between, road[last + 2 :]))
    status, found = of_c(
        double, given_points, last, last + by + 2, double.config("seam", interval_m=interval_m)
    )
    assert status == 0
    outside = np.delete(found, np.s_[last + 1 : last + by + 2])
    np.testing.assert_allclose(outside, sdk, rtol=0, atol=1e-10)


@settings(max_examples=30, deadline=None)
@given(
    grade=st.floats(-0.1, 0.1),
    step=st.floats(-1.0, 1.0),
    last=st.integers(1, 300),
    way=st.integers(1, 90),
)
def test_a_line_stays_one_whatever_the_step(build, grade, step, last, way):
    for library, atol in ((build("double"), 1e-12), (build("float"), 1e-4)):
        line = grade * 0.05 * np.arange(500)
        stepped = np.array(line)
        stepped[last + way :] += step
        config = library.config("seam", interval_m=0.05)
        status, found = of_c(library, stepped, last, last + way, config)
        assert status == 0
        np.testing.assert_allclose(found, line, rtol=0, atol=atol)


def test_behind_the_first_point_there_is_no_grade(double):
    status, found = of_c(double, [5.0, 0.0, 9.0, 8.0], 0, 2, double.config("seam", interval_m=1.0))
    assert (status, found.tolist()) == (0, [5.0, 5.0, 5.0, 4.0])


@pytest.mark.parametrize(("last", "behind"), [(3, 3), (4, 3), (2, 10), (2**62, 2**63)])
@pytest.mark.parametrize("interval_m", [0.25])
def test_points_that_are_none_of_the_profile_are_refused(double, last, behind, interval_m):
    config = double.config("seam", interval_m=interval_m)
    status, found = of_c(double, np.arange(10.0), last, behind, config)
    assert double.status[status] == "FR_BAD_CONFIG"
    assert found.tolist() == np.arange(10.0).tolist()


@pytest.mark.parametrize("name", ["interval_m", "grade_m", "point_m"])
@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
def test_lengths_that_are_none_are_refused(double, name, value):
    config = double.config("seam", **{"interval_m": 0.25, name: value})
    assert double.status[of_c(double, np.arange(10.0), 2, 4, config)[0]] == "FR_BAD_CONFIG"
