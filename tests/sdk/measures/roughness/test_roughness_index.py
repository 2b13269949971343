"""The IRI: laws of a linear car, its conventions, and a measured road."""

from importlib.resources import files

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import GOLDEN_CAR, IriSettings, iri, iri_segments, iri_trace
from floatref.measures.roughness.quarter_car import moving_average_response

MEASURED_ROAD = files("floatref_conformance.proving_ground") / "data/sroubek/profile_1.txt"
FEW = settings(deadline=None, max_examples=15)
intervals = st.sampled_from([0.0005, 0.00508, 0.02, 0.05, 0.1, 0.1524, 0.25, 0.3, 1.0, 2.0])
seeds = st.integers(0, 2**32 - 1)


def rough_road(seed: int, interval: float, length: float = 60.0) -> np.ndarray:
    count = int(length / interval) + 2
    slope = np.random.default_rng(seed).normal(0.0, 2e-3, count)
    return np.cumsum(slope) * np.sqrt(interval)


@given(seed=seeds, interval=intervals, offset=st.floats(-500.0, 500.0), slope=st.floats(-0.1, 0.1))
@FEW
def test_datum_and_uniform_grade_do_not_matter(
    seed: int, interval: float, offset: float, slope: float
) -> None:
    z = rough_road(seed, interval)
    graded = z + offset + slope * interval * np.arange(z.size)
    assert iri(graded, interval) == pytest.approx(iri(z, interval), rel=1e-6)


@pytest.mark.cites("(2.7)", "(2.9)")
@pytest.mark.parametrize("wavelength", [0.7, 1.5, 2.2, 5.0, 12.0, 16.0, 30.0, 60.0])
def test_sinusoid_is_amplified_as_the_two_responses_say(wavelength: float) -> None:
    interval, slope_amplitude = 0.005, 1e-3
    settled = round(200.0 / interval)
    x = interval * np.arange(settled + round(5 * wavelength / interval) + 51)
    z = slope_amplitude * wavelength / (2 * np.pi) * np.sin(2 * np.pi * x / wavelength)
    omega = 2 * np.pi / wavelength * 80.0 / 3.6
    gain = abs(GOLDEN_CAR.stroke_response(np.array([omega]))[0])
    gain *= abs(moving_average_response(np.array([1 / wavelength]), 0.25)[0])
    steady = iri_trace(z, interval)[settled:-50]
    assert np.mean(np.abs(steady)) == pytest.approx(2 / np.pi * gain, rel=2e-3)


def test_segment_boundaries_do_not_drift_from_whole_multiples() -> None:
    interval, segment = 0.00508, 0.9
    z = rough_road(1, interval, 200.0)
    cut = iri_segments(z, interval, IriSettings(segment_m=segment))
    for index, found in enumerate(cut):
        assert abs(found.start_m - index * segment) <= interval / 2 * 1.001


def test_measured_road_has_its_published_value() -> None:
    z = np.loadtxt(MEASURED_ROAD)[:, 1]
    assert iri(z, 0.25) == pytest.approx(3.334, rel=1e-3)
    hundreds = iri_segments(z, 0.25, IriSettings(segment_m=100.0))[:5]
    assert np.mean([s.iri_m_per_km for s in hundreds]) == pytest.approx(3.2175, rel=1e-3)


def test_speed_moves_the_car_along_the_wavelengths() -> None:
    z = rough_road(5, 0.25, 400.0)
    half_speed = IriSettings(moving_average_m=0.0, speed_kmh=40.0, start_length_m=5.5)
    full_speed = IriSettings(moving_average_m=0.0, speed_kmh=80.0, start_length_m=11.0)
    # The same elevations at half the interval and half the speed, slopes twice as large.
    assert iri(z, 0.125, half_speed) == pytest.approx(2 * iri(z, 0.25, full_speed), rel=1e-9)


def test_gap_is_bridged_by_a_straight_line() -> None:
    z = rough_road(6, 0.05)
    gap, line = z.copy(), z.copy()
    gap[300:321] = np.nan
    line[299:322] = np.linspace(z[299], z[321], 23)
    assert iri(gap, 0.05) == pytest.approx(iri(line, 0.05), rel=1e-12)


def test_ends_that_were_not_measured_are_left_out() -> None:
    z = rough_road(7, 0.05)
    padded = np.concatenate((np.full(40, np.nan), z, np.full(17, np.nan)))
    assert iri(padded, 0.05) == pytest.approx(iri(z, 0.05), rel=1e-12)
    trace = iri_trace(padded, 0.05)
    np.testing.assert_array_equal(trace[40 : 40 + z.size - 1], iri_trace(z, 0.05))
    assert np.isnan(trace[:40]).all()
    assert np.isnan(trace[40 + z.size - 1 :]).all()
    first, second = iri_segments(padded, 0.05, IriSettings(segment_m=2.0))[:2]
    assert np.isnan(first.iri_m_per_km)
    assert second.iri_m_per_km > 0


def test_input_is_not_changed_and_may_be_read_only() -> None:
    z = rough_road(8, 0.05)
    z[100] = np.nan
    kept = z.copy()
    z.flags.writeable = False
    iri(z, 0.05)
    iri_segments(z[::2], 0.1, IriSettings(segment_m=10.0))
    np.testing.assert_array_equal(z, kept)


@pytest.mark.parametrize(
    ("elevation", "interval", "text"),
    [
        (np.zeros(200), 0.05, "9.95 m of profile were measured; the car needs 11 m"),
        (np.full(1000, np.nan), 0.05, "0 of 1000 elevations are finite"),
        (np.zeros(0), 0.05, "0 of 0 elevations"),
        (np.full(1000, np.inf), 0.05, "infinite"),
        (np.zeros((1000, 2)), 0.05, "one wheel path at a time"),
        (np.zeros(1000), 0.0, "interval is 0"),
        (np.zeros(1000), float("nan"), "interval is nan"),
        (np.zeros(1000), 2.5, "needs 2 m or less"),
    ],
)
def test_unusable_profile_is_refused(elevation: np.ndarray, interval: float, text: str) -> None:
    for measure in (iri, iri_trace, iri_segments):
        with pytest.raises(InputError, match=text):
            measure(elevation, interval)


def test_segment_shorter_than_the_interval_is_refused() -> None:
    with pytest.raises(InputError, match=r"segment is 0.01 m, less than the interval 0.05 m"):
        iri_segments(np.zeros(1000), 0.05, IriSettings(segment_m=0.01))


@pytest.mark.parametrize("segment", [49.95, 50.0, 1e6, 1e308])
def test_a_segment_longer_than_the_profile_is_all_of_it(segment: float) -> None:
    z = rough_road(9, 0.05)[:1000]
    (only,) = iri_segments(z, 0.05, IriSettings(segment_m=segment), start_m=3.0)
    assert (only.start_m, only.length_m) == (3.0, pytest.approx(49.95))
    assert only.iri_m_per_km == pytest.approx(iri(z, 0.05), rel=1e-12)


def test_a_start_longer_than_all_profiles_is_refused() -> None:
    with pytest.raises(InputError, match=r"the car needs 1e\+308 m"):
        iri(rough_road(9, 0.05), 0.05, IriSettings(start_length_m=1e308))


@pytest.mark.parametrize("height", [1.1e6, -1.7e308])
def test_an_elevation_that_no_road_has_is_refused_by_its_point(height: float) -> None:
    z = rough_road(10, 0.05)
    z[100] = np.nan
    for kept in (z, np.nan_to_num(z)):
        kept[200:202] = height, -height
        with pytest.raises(InputError, match=r"elevation of point 200 is -?1\.\de\+\d+ m, beyond"):
            iri(kept, 0.05)
