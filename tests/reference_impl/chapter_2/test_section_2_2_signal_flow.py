"""Integration in the distance domain and the effect of the filter type."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2 import section_2_2_signal_flow as section


def test_mean_acceleration_of_the_example_rises_by_more_than_73_m() -> None:
    assert 73 < section.parabolic_rise(0.000834, 4000, 107 / 3.6) < 75


@settings(deadline=None, max_examples=15)
@given(bias_g=st.floats(-0.01, 0.01), speed=st.floats(1.0, 40.0))
def test_integration_over_distance_finds_the_parabola_of_time(bias_g: float, speed: float) -> None:
    a = np.full(101, bias_g * 9.80665)
    height = section.floating_reference_height(
        section.spatial_acceleration(a, np.full(101, speed)), 0.5
    )
    expected = section.parabolic_rise(bias_g, 50, speed)
    assert height[-1] == pytest.approx(expected, rel=1e-12, abs=1e-15)


def test_only_the_conventional_filter_shifts_the_phase() -> None:
    dx, wavelength = 0.5, 91.44
    x = np.arange(-2000, 2001) * dx
    z = np.cos(2 * np.pi * x / wavelength)
    conventional = section.conventional_high_pass(z, dx)
    bidirectional = section.bidirectional_high_pass(z, dx)
    middle = slice(1800, 2201)
    assert bidirectional[middle] == pytest.approx(math.sqrt(0.5) * z[middle], abs=2e-4)
    lead = np.cos(2 * np.pi * x / wavelength + 0.75 * np.pi)
    assert conventional[middle] == pytest.approx(math.sqrt(0.5) * lead[middle], abs=2e-3)
