"""Memory of the road prior: a formula of lag, nodes and points, and doubles in both builds."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import iri

ENCODER = {"rate_hz": 4000.0, "metres_per_count": 1e-3}


def size(library, **changed):
    config = library.config("road_prior", **{**ENCODER, "interval_m": 0.05, **changed})
    return library.lib.fr_road_prior_size(config)


@settings(deadline=None, max_examples=50)
@given(
    lag_s=st.floats(5.0, 300.0),
    node_rate_hz=st.sampled_from([50.0, 100.0, 250.0, 500.0]),
    fastest_mps=st.floats(5.0, 60.0),
    interval_m=st.floats(0.01, 1.0),
)
def test_the_size_is_that_of_the_page_s_formula(
    double, lag_s, node_rate_hz, fastest_mps, interval_m
):
    """Within rounding up to whole nodes, points and marks, and the parts that are always there."""
    lag = {"lag_s": lag_s, "node_rate_hz": node_rate_hz, "fastest_mps": fastest_mps}
    found = size(double, interval_m=interval_m, **lag)
    nodes, points = lag_s * node_rate_hz, lag_s * fastest_mps / interval_m
    marks = 2.0 * lag_s * fastest_mps / 8.0 + 1.25 * 1.5 * lag_s / 0.5
    formula = 480.0 * nodes + 48.0 * points + 992.0 * marks
    fixed = 992.0 * 130 + 17_000
    assert formula < found < formula + fixed


def test_both_builds_take_the_same_memory(double, single):
    assert size(double) == size(single)


@pytest.mark.parametrize("changed", [{"lag_s": 4000.0}, {"interval_m": 1e-9}, {"tilt_sigma": 0.0}])
def test_what_cannot_be_has_no_size(double, changed):
    assert size(double, **changed) == 0


@pytest.mark.parametrize("rate", [200.0, 1000.0])
def test_in_float_the_elevation_is_that_of_double(drives, smoothed, single, rate):
    """Samples are rounded, states are not."""
    v = drives.speeds(20.0, rate, 9.0, 8.0, 3.0)
    drive = drives.heaving(rate, drives.travelled(v, rate))
    rounded = [x.astype(np.float32).astype(float) for x in (drive.a, drive.h)]
    drive = drives.Drive(rate, *rounded, drive.counts)
    ours, theirs = (smoothed(drive, 0.25, lag_s=5.0, **s) for s in ({"library": single}, {}))
    off = ours.elevation - theirs.elevation
    assert np.abs(off).max() < 2.0**-23 * np.abs(theirs.elevation).max()
    assert iri(off, 0.25) < 1e-3
    assert (ours.flags == theirs.flags).all()
