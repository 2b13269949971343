"""Lines from places: what is known is there, in order, and no line crosses the 180th meridian."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.files.gis.lines import known_lines

steps = st.lists(st.tuples(st.floats(-0.01, 0.01), st.floats(-0.01, 0.01)), min_size=2, max_size=30)


@st.composite
def roads(draw):
    """Latitudes and longitudes of a road, some unknown, often near the 180th meridian."""
    found = np.array(draw(steps))
    latitude = draw(st.floats(-80.0, 80.0)) + np.cumsum(found[:, 0])
    start = draw(st.sampled_from([180.0, -180.0, 0.0, 12.0]))
    longitude = np.mod(start + np.cumsum(found[:, 1]) + 180.0, 360.0) - 180.0
    unknown = np.array(draw(st.lists(st.booleans(), min_size=len(found), max_size=len(found))))
    return np.where(unknown, np.nan, latitude), longitude


@given(road=roads())
def test_every_known_place_that_has_a_neighbour_is_on_a_line_in_order(road):
    latitude, longitude = road
    known = np.isfinite(latitude)
    beside = np.zeros(known.size, dtype=bool)
    beside[1:] |= known[:-1]
    beside[:-1] |= known[1:]
    expected = [
        (round(east, 7), round(north, 7))
        for east, north in zip(
            longitude[known & beside].tolist(), latitude[known & beside].tolist(), strict=True
        )
    ]
    lines = known_lines(latitude, longitude)
    places = iter([place for line in lines for place in line])
    assert all(place in places for place in expected)


@given(road=roads())
def test_lines_are_short_steps_within_the_meridians(road):
    for line in known_lines(*road):
        assert len(line) >= 2
        east = np.array([place[0] for place in line])
        assert np.abs(east).max() <= 180.0
        assert np.abs(np.diff(east)).max() < 0.011


def test_the_meridian_is_crossed_where_the_road_crosses_it():
    lines = known_lines(np.array([10.0, 20.0]), np.array([179.0, -178.0]))
    latitude = round(10.0 + 10.0 / 3.0, 7)
    assert lines == (
        ((179.0, 10.0), (180.0, latitude)),
        ((-180.0, latitude), (-178.0, 20.0)),
    )
    (back,) = {known_lines(np.array([20.0, 10.0]), np.array([-178.0, 179.0]))}
    assert [line[::-1] for line in back[::-1]] == list(lines)


def test_a_lone_place_is_no_line():
    nan = np.nan
    assert known_lines(np.array([nan, 1.0, nan]), np.array([1.0, 1.0, 1.0])) == ()
    assert known_lines(np.array([]), np.array([])) == ()
