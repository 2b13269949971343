"""The SDK's measures of ride and the reference's, written apart from the same sources, agree."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import (
    Profilograph,
    TraceRules,
    Waveband,
    bumps_and_dips,
    deviation_from_average,
    half_car_roughness_index,
    hpms_sections,
    iri,
    join_profile_indices,
    localized_roughness,
    mean_path,
    mean_roughness_index,
    must_grind,
    profile_indices,
    profilograph_trace,
    ride_number,
    ride_profile_index,
    rolling_straightedge,
    straightedge_deviation,
    valid_frames,
    waveband_energy,
)
from floatref_reference.ride_measures import (
    bands,
    lane,
    localized,
    profilograph,
    sections,
    straightedge,
)

FEW = settings(deadline=None, max_examples=8)
CLOSE = 1e-9
intervals = st.sampled_from([0.05, 0.0762, 0.1, 0.25, 0.3])
seeds = st.integers(0, 2**32 - 1)


def rough_road(seed: int, interval: float, length: float = 45.0) -> np.ndarray:
    """Return a road with waves of all lengths and some bumps."""
    rng = np.random.default_rng(seed)
    count = int(length / interval) + 2
    z = 5.0 * rng.random() + np.cumsum(rng.normal(0.0, 3e-3, count)) * np.sqrt(interval)
    for place in rng.integers(0, count - 10, 3):
        z[place : place + max(round(0.8 / interval), 2)] += rng.normal(0.0, 0.02)
    return z


def same_places(found, expected, names: tuple[str, ...]) -> None:
    """Check that areas and their peaks are those of the reference."""
    flat = [[getattr(each, name) for name in names] for each in found]
    np.testing.assert_allclose(
        np.array(flat, dtype=float).reshape(-1, 4),
        np.array(expected, dtype=float).reshape(-1, 4),
        rtol=CLOSE,
        atol=CLOSE,
    )


@given(seed=seeds, interval=intervals, threshold=st.floats(1.0, 6.0))
@FEW
def test_localized_roughness(seed: int, interval: float, threshold: float) -> None:
    z = rough_road(seed, interval)
    found = localized_roughness(z, interval, threshold)
    expected = localized.localized_roughness(z, interval, threshold)
    same_places(found, expected, ("start_m", "end_m", "peak_at_m", "peak_m_per_km"))


@given(seed=seeds, interval=intervals, limit=st.floats(0.001, 0.006))
@FEW
def test_bumps_and_dips(seed: int, interval: float, limit: float) -> None:
    z = rough_road(seed, interval)
    d = deviation_from_average(z, interval)
    expected = np.array(localized.deviation(z, interval), dtype=float)
    np.testing.assert_allclose(d[np.isfinite(d)], expected, rtol=0, atol=CLOSE)
    found = bumps_and_dips(z, interval, limit)
    places = localized.bumps_and_dips(z, interval, limit)
    same_places(found, places, ("start_m", "end_m", "peak_at_m", "deviation_m"))


@given(seed=seeds, interval=intervals)
@FEW
def test_indices_of_a_lane(seed: int, interval: float) -> None:
    left, right = (rough_road(seed + k, interval) for k in range(2))
    mri = mean_roughness_index(iri(left, interval), iri(right, interval))
    assert mri == pytest.approx(float(lane.mean_roughness_index(left, right, interval)), rel=CLOSE)
    hri = half_car_roughness_index(left, right, interval)
    assert hri == pytest.approx(
        float(lane.half_car_roughness_index(left, right, interval)), rel=CLOSE
    )
    np.testing.assert_allclose(
        mean_path(left, right, interval), lane.mean_path(left, right).astype(float), rtol=CLOSE
    )


@given(seed=seeds, interval=intervals)
@FEW
def test_ride_number(seed: int, interval: float) -> None:
    paths = [rough_road(seed + k, interval) for k in range(2)]
    found = [ride_profile_index(z, interval) for z in paths]
    expected = [lane.profile_index(z, interval) for z in paths]
    assert found == pytest.approx([float(pi) for pi in expected], rel=CLOSE)
    assert ride_number(join_profile_indices(*found)) == pytest.approx(
        float(lane.ride_number(*expected)), rel=CLOSE
    )


@given(seed=seeds, interval=intervals, length=st.sampled_from([3.0, 3.048, 4.8768]))
@FEW
def test_straightedge(seed: int, interval: float, length: float) -> None:
    z = rough_road(seed, interval)
    d = straightedge_deviation(z, interval, length)
    expected = np.array(straightedge.midpoint_deviation(z, interval, length), dtype=float)
    np.testing.assert_allclose(d[np.isfinite(d)], expected, rtol=0, atol=CLOSE)
    found = rolling_straightedge(z, interval, length, 0.004).areas
    places = straightedge.beyond_tolerance(z, interval, 0.004, length)
    same_places(found, places, ("start_m", "end_m", "peak_at_m", "deviation_m"))


@given(seed=seeds, interval=intervals, wheels=st.sampled_from([(-3.81, 3.81), (-4.2, -3.0, 3.5)]))
@FEW
def test_profilograph(seed: int, interval: float, wheels: tuple[float, ...]) -> None:
    z = rough_road(seed, interval)
    machine = Profilograph(wheels)
    trace, sound = profilograph_trace(z, interval, machine), valid_frames(z, interval, machine)
    first, t = profilograph.trace(z, interval, wheels)
    assert np.flatnonzero(np.isfinite(trace))[0] == first
    np.testing.assert_allclose(
        trace[np.isfinite(trace)], np.array(t, dtype=float), rtol=0, atol=CLOSE
    )
    for band in (0.0, 0.00508):
        rules = TraceRules(blanking_band_m=band, segment_m=1000.0)
        (found,) = profile_indices(trace, sound, interval, rules)
        expected = float(profilograph.profile_index(t, interval, band))
        assert found.profile_index_m_per_km == pytest.approx(expected, rel=CLOSE)
        assert found.scallops == len(profilograph.scallops(t, interval, band))


@pytest.mark.slow
@given(seed=seeds, interval=st.sampled_from([0.1, 0.25]))
@FEW
def test_must_grind(seed: int, interval: float) -> None:
    z = 2.0 * rough_road(seed, interval)
    trace, sound = profilograph_trace(z, interval), valid_frames(z, interval)
    first, t = profilograph.trace(z, interval)
    found = must_grind(trace, sound, interval, start_m=-first * interval)
    places = profilograph.must_grind(t, interval)
    same_places(found, places, ("start_m", "end_m", "peak_at_m", "height_m"))


@given(
    seed=seeds,
    interval=intervals,
    band=st.sampled_from([Waveband(8.0, 1.6), Waveband(1.6, 0.3), Waveband(60.0, 8.0)]),
)
@FEW
def test_waveband_energy(seed: int, interval: float, band: Waveband) -> None:
    z = rough_road(seed, interval, 20.0)
    found = waveband_energy(z, interval, band)
    expected = bands.waveband_energy(z, interval, *band)
    assert found.rms_elevation_m == pytest.approx(float(expected.elevation), rel=CLOSE, abs=1e-15)
    assert found.rms_slope == pytest.approx(float(expected.slope), rel=CLOSE, abs=1e-15)


@given(seed=seeds, interval=intervals, section=st.floats(5.0, 60.0))
@FEW
def test_sections(seed: int, interval: float, section: float) -> None:
    paths = [rough_road(seed + k, interval) for k in range(2)]
    found = hpms_sections(paths, interval, section_m=section)
    expected = sections.sections(paths, interval, section)
    assert [each.rating for each in found] == [each.rating for each in expected]
    flat = [(each.start_m, each.length_m, each.mean_m_per_km) for each in found]
    wanted = np.array([each[:3] for each in expected], dtype=float)
    np.testing.assert_allclose(flat, wanted, rtol=CLOSE)
