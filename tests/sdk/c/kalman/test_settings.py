"""Defaults of the Kalman objects are the SDK's, and their memory is a formula of the settings."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.builtin_pipelines.chapter_6 import KALMAN, NOISE
from floatref.estimators.kalman import Noise, Plan
from floatref.values.channels import STANDARD_GRAVITY

INERTIAL = "kalman-smoother-constant-height-attitude"


def noise_of(config):
    return {name: getattr(config.noise, name) for name in vars(Noise())}


def test_the_defaults_are_those_of_the_sdk(double):
    config, plan = double.lib.fr_kalman_filter_defaults(), Plan()
    assert noise_of(config) == vars(Noise())
    assert (config.gnss, config.attitude, config.reflects) == (1, 1, 1)
    assert config.reflection_speed_mps == plan.reflection_speed_mps
    assert config.gravity_mps2 == STANDARD_GRAVITY


def test_without_gnss_they_are_those_of_its_pipeline(double):
    (pipeline,) = [each for each in KALMAN if each.name == INERTIAL]
    found = double.lib.fr_kalman_inertial_defaults()
    assert noise_of(found.filter) == {f: pipeline.settings[name] for name, f in NOISE.items()}
    assert (found.filter.gnss, found.filter.attitude, found.filter.reflects) == (0, 0, 1)
    assert found.lag_s == 3 * double.lib.fr_kalman_defaults().lag_s


def size(library, **changed):
    travel = {"filter__travel__rate_hz": 4000.0, "filter__travel__metres_per_count": 1e-3}
    config = library.config("kalman", **{**travel, "interval_m": 0.05, **changed})
    return library.lib.fr_kalman_size(config)


@settings(deadline=None, max_examples=50)
@given(
    lag_s=st.floats(5.0, 300.0),
    gnss_hz=st.floats(1.0, 100.0),
    fastest_mps=st.floats(5.0, 60.0),
    interval_m=st.floats(0.01, 1.0),
)
def test_the_size_is_that_of_the_formula(double, lag_s, gnss_hz, fastest_mps, interval_m):
    """Within rounding up to whole nodes, points and marks, and what is always there."""
    lag = {"lag_s": lag_s, "gnss_hz": gnss_hz, "fastest_mps": fastest_mps}
    found, hz = size(double, interval_m=interval_m, **lag), 101.0 + gnss_hz
    each = 1656 * hz + 48 * fastest_mps / interval_m + 468 * fastest_mps + 70 * hz
    assert 0 < found - lag_s * each < 320_000 + 0.01 * found


def test_both_builds_take_the_same_memory(double, single):
    assert size(double) == size(single)


@pytest.mark.parametrize(
    "changed",
    [{"lag_s": 4000.0}, {"interval_m": 1e-9}, {"filter__noise__reflection": 0.0}]
    + [{"filter__late_s": -1.0}, {"filter__noise__roll_rate": np.nan}, {"filter__gnss": 2}]
    + [{"filter__travel__rate_hz": 1.0}, {"filter__readings": 0}, {"gnss_hz": np.inf}],
)
def test_what_cannot_be_has_no_size(double, changed):
    assert size(double, **changed) == 0


def test_in_float_the_points_are_those_of_double(drive, path_of, smoothed, single):
    """Inputs and states are double there, too; elevation and 1-sigma are rounded once."""
    drawn = drive(1, 30.0)
    whole = smoothed(path_of("kalman", drawn, interval_m=0.25, lag_s=5.0), drawn)
    path = path_of("kalman", drawn, library=single, interval_m=0.25, lag_s=5.0)
    for one, other in zip(smoothed(path, drawn), whole, strict=True):
        np.testing.assert_allclose(one, other, rtol=2.0**-23)
