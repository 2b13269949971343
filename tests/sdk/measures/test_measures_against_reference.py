"""The SDK's measures and the reference's, written apart from the same equations, agree."""

from dataclasses import astuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import (
    BANDS,
    WAVEBANDS,
    IriSettings,
    agreement,
    iri,
    iri_segments,
    iri_trace,
    short_interval_roughness,
)
from floatref_reference.chapter_2 import (
    section_2_1_1_iri,
    section_2_1_2_iri_scale,
    section_2_1_3_roughness_profiles,
    section_2_1_5_comparison,
)

FEW = settings(deadline=None, max_examples=8)
intervals = st.sampled_from([0.02, 0.05, 0.0762, 0.1, 0.2, 0.25, 0.3, 0.5, 1.0])
seeds = st.integers(0, 2**32 - 1)


def rough_road(seed: int, interval: float, length: float = 24.0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    count = int(length / interval) + 2
    slope = rng.normal(0.0, 2e-3, count) * np.sqrt(interval)
    return 500.0 * rng.random() + 0.05 * interval * np.arange(count) + np.cumsum(slope)


@pytest.mark.cites("section 2.1.1")
@given(seed=seeds, interval=intervals)
@FEW
def test_trace_and_iri(seed: int, interval: float) -> None:
    z = rough_road(seed, interval)
    expected = section_2_1_1_iri.iri_trace(z, interval).astype(float)
    np.testing.assert_allclose(iri_trace(z, interval), expected, atol=1e-8)
    assert iri(z, interval) == pytest.approx(float(section_2_1_1_iri.iri(z, interval)), rel=1e-8)


@given(seed=seeds, interval=intervals)
@FEW
def test_segments(seed: int, interval: float) -> None:
    z = rough_road(seed, interval)
    expected = section_2_1_2_iri_scale.segment_iri(z, interval, 7.3)
    found = iri_segments(z, interval, IriSettings(segment_m=7.3))
    flat = [(s.start_m, s.length_m, s.iri_m_per_km) for s in found]
    np.testing.assert_allclose(flat, np.array(expected, dtype=float), rtol=1e-7)


@pytest.mark.cites("section 2.1.3")
@given(seed=seeds, interval=intervals)
@FEW
def test_short_interval_roughness(seed: int, interval: float) -> None:
    z = rough_road(seed, interval)
    expected = section_2_1_3_roughness_profiles.short_interval_roughness(z, interval)
    found = short_interval_roughness(z, interval)
    np.testing.assert_allclose(found, expected.astype(float), rtol=1e-7)


@pytest.mark.cites("(2.16)")
@pytest.mark.parametrize("band", BANDS)
@given(seed=seeds, noise=st.floats(1e-4, 3e-3), shift=st.integers(-6, 6))
@settings(deadline=None, max_examples=3)
def test_agreement_in_every_band(band: str, seed: int, noise: float, shift: int) -> None:
    interval = 0.06
    longer = rough_road(seed, interval, 16.0)
    p = longer[10:-10]
    q = longer[10 - shift : longer.size - 10 - shift]
    q = q + np.random.default_rng(seed + 1).normal(0.0, noise, q.size)
    filtered = [reference_filtered(z, interval, band) for z in (p, q)]
    expected = section_2_1_5_comparison.agreement(*filtered, interval, 0.4)
    found = agreement(p, q, interval, band, 0.4)
    values = [float(value) for value in expected]
    assert values == pytest.approx(list(astuple(found)), abs=1e-7)


def reference_filtered(z: np.ndarray, interval: float, band: str) -> np.ndarray:
    """The reference's filter; a waveband on slope without mean, mirrored at both ends."""
    if band == "iri":
        return section_2_1_5_comparison.filtered(z, interval, band)
    margin = int(np.ceil(WAVEBANDS[band].long_m / interval))
    slope = np.diff(z)
    mirrored = np.pad(slope - slope.mean(), margin, mode="symmetric")
    elevation = np.concatenate(([0.0], np.cumsum(mirrored)))
    whole = section_2_1_5_comparison.filtered(elevation, interval, band)
    return whole[margin : margin + slope.size]
