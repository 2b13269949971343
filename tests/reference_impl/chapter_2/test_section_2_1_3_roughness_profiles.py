"""The short-interval roughness profile localizes what the IRI averages."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2.section_2_1_1_iri import iri, iri_trace
from floatref_reference.chapter_2.section_2_1_3_roughness_profiles import (
    peak_roughness,
    short_interval_roughness,
)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 99))
def test_base_length_of_one_interval_is_the_rectified_trace(seed: int) -> None:
    z = np.random.default_rng(seed).normal(size=100) * 1e-3
    assert (short_interval_roughness(z, 0.1, 0.1) == np.abs(iri_trace(z, 0.1))).all()


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 99), points=st.integers(20, 120))
def test_base_length_of_the_whole_profile_is_the_iri_at_its_middle(seed: int, points: int) -> None:
    z = np.random.default_rng(seed).normal(size=points) * 1e-3
    roughness = short_interval_roughness(z, 0.1, (points - 1) * 0.1)
    assert roughness[(points - 1) // 2] == pytest.approx(float(iri(z, 0.1)), rel=1e-12)


@pytest.mark.parametrize("place", [150, 200, 300])
def test_roughness_of_a_step_stays_within_a_window_around_the_ride_after_it(place: int) -> None:
    dx = 0.1
    z = np.where(np.arange(1000) < place, 0.0, 0.02)
    trace = np.abs(iri_trace(z, dx))
    roughness = short_interval_roughness(z, dx)
    disturbed = np.nonzero(roughness > 1e-6)[0][0]
    assert disturbed * dx == pytest.approx(np.nonzero(trace > 1e-6)[0][0] * dx - 3.81, abs=2 * dx)
    assert peak_roughness(z, dx) == roughness.max() < trace.max()
    assert place <= roughness.argmax() <= place + 2 * 38
