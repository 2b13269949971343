"""Axles are stated from the vehicle point; unknown ones are those of the vehicle of section 4.2."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref import AxleSetup, Setup, TrackSetup
from floatref.errors import InputError
from floatref.values.axle_setup import FARTHEST_M, LONGEST_M, SHORTEST_M

WHEELBASES = st.floats(SHORTEST_M, LONGEST_M)
PLACES = st.floats(-FARTHEST_M, FARTHEST_M)


@given(WHEELBASES, PLACES)
def test_the_rear_axle_is_a_wheelbase_behind_the_front_one(length_m: float, front_m: float) -> None:
    axles = AxleSetup(length_m, front_m)
    assert (axles.wheelbase_m, axles.front_axle_m) == (length_m, front_m)
    assert math.isclose(axles.front_axle_m - axles.rear_axle_m, length_m, abs_tol=1e-12)


@pytest.mark.parametrize("length_m", [0.0, -3.0, 0.49, 20.1, math.nan, math.inf, 3430.0])
def test_a_wheelbase_of_no_vehicle_is_refused(length_m: float) -> None:
    said = r"setup\.axles\.wheelbase_m is .*; give it in m, between 0\.5 and 20"
    with pytest.raises(InputError, match=said):
        AxleSetup(length_m, 0.0)


@pytest.mark.parametrize("front_m", [-101.0, 1720.0, math.nan, math.inf])
def test_an_axle_outside_all_vehicles_is_refused(front_m: float) -> None:
    said = r"setup\.axles\.front_axle_m is .*; give it in m, within 100 m"
    with pytest.raises(InputError, match=said):
        AxleSetup(3.0, front_m)


@given(st.floats(-50.0, 50.0))
def test_unknown_axles_are_those_of_section_4_2_about_the_accelerometer(place_m: float) -> None:
    """Wheelbase 135 in; the profiler 1.2 m behind the rear axle."""
    setup = Setup(tracks={"left": TrackSetup((place_m, 0.8, 0.3))})
    axles = setup.axles_about("left")
    assert math.isclose(axles.wheelbase_m, 135 * 0.0254, abs_tol=2e-3)
    assert math.isclose(axles.rear_axle_m - place_m, 1.2, abs_tol=1e-9)
    assert setup.axles_about("right").front_axle_m == AxleSetup.usual(0.0).front_axle_m


@given(WHEELBASES, PLACES, PLACES)
def test_stated_axles_hold_for_every_wheel_path(
    length_m: float, front_m: float, place_m: float
) -> None:
    axles = AxleSetup(length_m, front_m)
    setup = Setup(axles=axles, tracks={"left": TrackSetup((place_m, 0.8, 0.3))})
    assert setup.axles_about("left") is setup.axles_about("right") is axles
