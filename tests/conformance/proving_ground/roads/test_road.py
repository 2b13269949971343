import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.roads.road import Road, flat_road, lateral_positions

PLACES = st.floats(-60.0, 160.0)


def plane(grade: float, cross_slope: float) -> Road:
    x = -20.0 + 0.1 * np.arange(1401)
    sides = {"left": 0.9, "middle": 0.2, "right": -0.8}
    return Road(-20.0, 0.1, {n: grade * x + cross_slope * y for n, y in sides.items()}, sides)


@given(st.lists(PLACES, min_size=1, max_size=30))
@settings(deadline=None, max_examples=50)
def test_a_plane_is_met_between_points_and_held_beyond_the_ends(places: list[float]) -> None:
    x = np.array(places)
    expected = 0.03 * np.clip(x, -20.0, 120.0) + 0.02 * 0.9
    np.testing.assert_allclose(plane(0.03, 0.02).at("left", x), expected, atol=1e-12)


@given(st.floats(-20.0, 120.0), st.floats(-2.0, 2.0), st.floats(-0.1, 0.1))
@settings(deadline=None, max_examples=50)
def test_a_plane_is_met_at_every_lateral_position(x: float, y: float, cross_slope: float) -> None:
    z = plane(0.01, cross_slope).across(np.array([x]), np.array([y]))
    np.testing.assert_allclose(z, [0.01 * x + cross_slope * y], atol=1e-12)


def test_every_wheel_path_is_met_at_its_own_lateral_position() -> None:
    rng = np.random.default_rng(4)
    sides = {"b": -0.5, "a": 0.7, "c": 0.1}
    road = Road(0.0, 0.5, {n: rng.standard_normal(50) for n in sides}, sides)
    x = rng.uniform(0.0, 24.0, 200)
    for name, y in sides.items():
        np.testing.assert_allclose(road.across(x, np.full(200, y)), road.at(name, x), atol=1e-14)


def test_a_road_of_one_wheel_path_has_no_cross_slope() -> None:
    road = Road(0.0, 1.0, {"main": np.array([0.0, 1.0, 4.0])}, {"main": 0.0})
    np.testing.assert_allclose(road.across(np.array([1.5]), np.array([-3.0])), [2.5])


def test_the_grid_covers_the_vehicle_behind_the_start_and_beyond_the_length() -> None:
    road = flat_road(100.0, spacing_m=0.3)
    assert road.start_m == -20.0
    assert 120.0 <= road.end_m < 120.3
    assert road.distance_m[-1] == pytest.approx(road.end_m)


def test_elevations_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="read-only"):
        flat_road(10.0).elevation["left"][0] = 1.0


@pytest.mark.parametrize(
    ("spacing", "elevation", "sides", "message"),
    [
        (0.0, {"a": [0.0, 0.0]}, {"a": 0.0}, "spacing_m is 0.0"),
        (0.1, {"a": [0.0, 0.0]}, {"b": 0.0}, "lateral position per wheel path"),
        (0.1, {"a": [0.0, 0.0], "b": [0.0]}, {"a": 0.0, "b": 1.0}, "differ in length"),
        (0.1, {"a": [0.0, np.nan]}, {"a": 0.0}, "wheel path a: needs two or more points"),
        (0.1, {"a": [0.0, 0.0], "b": [0.0, 0.0]}, {"a": 1.0, "b": 1.0}, "same lateral position"),
    ],
)
def test_what_does_not_fit_together_is_refused(
    spacing: float,
    elevation: dict[str, list[float]],
    sides: dict[str, float],
    message: str,
) -> None:
    with pytest.raises(InputError, match=message):
        Road(0.0, spacing, {n: np.array(z) for n, z in elevation.items()}, sides)


def test_unknown_wheel_paths_are_named() -> None:
    with pytest.raises(InputError, match="wheel path middle: missing"):
        flat_road(10.0).at("middle", np.zeros(1))
    with pytest.raises(InputError, match="wheel path third: give its lateral position"):
        lateral_positions(("left", "third"))
    with pytest.raises(InputError, match="length_m is -1"):
        flat_road(-1.0)
