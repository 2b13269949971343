import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import measures
from floatref.errors import InputError
from floatref_conformance.proving_ground.roads.road import Road, flat_road
from floatref_conformance.proving_ground.roads.shaping import scale_to, with_bump, with_level_start


def wavy_road(length_m: float = 200.0) -> Road:
    flat = flat_road(length_m, spacing_m=0.05)
    x = flat.distance_m
    return flat.with_elevation(
        {
            "left": 3.0 + 0.04 * x + 0.01 * np.sin(x),
            "right": 3.1 + 0.04 * x + 0.02 * np.sin(x / 3),
        }
    )


def test_a_level_start_is_level_and_takes_one_line_off_the_rest() -> None:
    road = wavy_road()
    level = with_level_start(road)
    x = road.distance_m
    for name in road.tracks:
        assert not level.elevation[name][x <= 6.0].any()
    beyond = x >= 26.0
    removed = [(road.elevation[n] - level.elevation[n])[beyond] for n in road.tracks]
    np.testing.assert_allclose(removed[0], removed[1], atol=1e-12)
    assert np.abs(np.diff(removed[0], 2)).max() < 1e-12


def test_the_fade_in_adds_no_step_and_no_slope_beyond_the_roads_own() -> None:
    slope = np.diff(with_level_start(wavy_road()).elevation["left"]) / 0.05
    assert np.abs(slope).max() < 0.025


@given(st.floats(4.0, 20.0), st.floats(-0.05, 0.05), st.floats(0.3, 1.0), st.floats(40.0, 150.0))
@settings(deadline=None, max_examples=40)
def test_a_bump_has_its_height_its_length_and_its_place(
    length: float, height: float, share: float, centre: float
) -> None:
    road = flat_road(200.0, spacing_m=0.01)
    z = with_bump(road, centre, length, height, share * length / 2, ["left"]).at(
        "left", np.array([centre - length / 2, centre, centre + length / 2])
    )
    np.testing.assert_allclose(z, [0.0, height, 0.0], atol=abs(height) * 0.01 + 1e-12)
    bumped = with_bump(road, centre, length, height, share * length / 2, ["left"])
    area = 0.01 * bumped.elevation["left"].sum()
    assert area == pytest.approx(height * length * (1 - share / 2), rel=1e-3, abs=1e-9)
    assert not bumped.elevation["right"].any()


@given(st.floats(0.2, 20.0))
@settings(deadline=None, max_examples=10)
def test_scaling_meets_the_mean_iri_and_keeps_the_wheel_paths_ratio(target: float) -> None:
    road = with_level_start(wavy_road())
    scaled = scale_to(road, target)
    x = road.distance_m
    part = (x >= 26.0) & (x <= road.end_m - 20.0)
    values = [measures.iri(z[part], road.spacing_m) for z in scaled.elevation.values()]
    assert np.mean(values) == pytest.approx(target, rel=1e-9)
    factors = [scaled.elevation[n][part] / road.elevation[n][part] for n in road.tracks]
    np.testing.assert_allclose(factors[0], factors[1], rtol=1e-9)


def test_impossible_changes_are_refused() -> None:
    flat = flat_road(100.0, spacing_m=0.05)
    with pytest.raises(InputError, match="without roughness"):
        scale_to(flat, 2.0)
    with pytest.raises(InputError, match="target IRI is 0"):
        scale_to(flat, 0.0)
    with pytest.raises(InputError, match="flank_m is 2"):
        with_bump(flat, 50.0, 3.0, 0.01, 2.0)
    with pytest.raises(InputError, match="wheel path third"):
        with_bump(flat, 50.0, 3.0, 0.01, tracks=["third"])
    with pytest.raises(InputError, match="no fade-in"):
        with_level_start(flat, 20.0, 10.0)
