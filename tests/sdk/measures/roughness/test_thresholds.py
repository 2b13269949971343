"""Wavelength thresholds: the printed tables, and laws of the share that they capture."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import INDICES, SAMPLE_ROADS, RoadSpectrum, wavelength_thresholds

FEW = settings(deadline=None, max_examples=15)
LONG = {
    "IRI": (42.88, 36.30, 20.43, 18.79),
    "GCARS120": (65.58, 59.63, 30.53, 29.23),
    "GCARS40": (19.88, 14.75, 10.42, 8.45),
    "PTRN": (16.55, 11.82, 8.65, 5.80),
}
SHORT = {
    "IRI": (1.47, 1.12, 0.96, 0.61),
    "GCARS120": (2.37, 1.80, 1.36, 0.86),
    "GCARS40": (0.68, 0.59, 0.57, 0.42),
    "PTRN": (0.38, 0.34, 0.34, 0.14),
}


@pytest.mark.cites("(2.5)", "(2.10)", "(2.11)", "Tables 2.4 to 2.6")
@pytest.mark.parametrize("index", list(INDICES))
def test_printed_tables_follow_from_the_equations(index: str) -> None:
    for road, long_m, short_m in zip(SAMPLE_ROADS, LONG[index], SHORT[index], strict=True):
        found = wavelength_thresholds(SAMPLE_ROADS[road], INDICES[index])
        assert abs(found.long_m - long_m) <= max(0.0015 * long_m, 0.02), (index, road)
        assert abs(found.short_m - short_m) <= max(0.0015 * short_m, 0.02), (index, road)


@given(speed=st.floats(20.0, 160.0))
@FEW
def test_without_smoothing_wavelengths_grow_with_speed(speed: float) -> None:
    car = INDICES["IRI"].car
    white = RoadSpectrum(0.0, 0.0)
    slow, fast = (
        wavelength_thresholds(white, type(INDICES["IRI"])(car, v, 0.0)) for v in (speed, 2 * speed)
    )
    assert fast.long_m == pytest.approx(2 * slow.long_m, rel=1e-3)
    assert fast.short_m == pytest.approx(2 * slow.short_m, rel=1e-2)


@given(shares=st.lists(st.floats(0.75, 0.999), min_size=2, max_size=2, unique=True))
@FEW
def test_a_larger_share_needs_a_wider_band(shares: list[float]) -> None:
    road = SAMPLE_ROADS["standard"]
    narrow, wide = (wavelength_thresholds(road, captured=s) for s in sorted(shares))
    assert wide.long_m > narrow.long_m
    assert wide.short_m < narrow.short_m
    assert narrow.short_m < narrow.long_m


def test_text_values_for_95_per_cent_on_the_standard_road() -> None:
    found = wavelength_thresholds(SAMPLE_ROADS["standard"], captured=0.95)
    assert found.long_m == pytest.approx(20.13, rel=2e-3)
    assert found.short_m == pytest.approx(1.85, abs=0.01)


@given(acceleration=st.floats(0.0, 20.0), elevation=st.floats(0.0, 0.2))
@FEW
def test_long_waves_lengthen_and_short_waves_shorten_the_band(
    acceleration: float, elevation: float
) -> None:
    base = wavelength_thresholds(RoadSpectrum(acceleration, elevation))
    wavier = wavelength_thresholds(RoadSpectrum(acceleration + 1.0, elevation))
    choppier = wavelength_thresholds(RoadSpectrum(acceleration, elevation + 0.01))
    assert wavier.long_m > base.long_m
    assert choppier.short_m < base.short_m


@pytest.mark.parametrize("captured", [0.0, 1.0, -0.5, 2.0, np.nan])
def test_impossible_share_is_refused(captured: float) -> None:
    with pytest.raises(InputError, match="captured share"):
        wavelength_thresholds(SAMPLE_ROADS["choppy"], captured=captured)
