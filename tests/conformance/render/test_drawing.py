"""The drawing of a manoeuvre: it fits a terminal and shows the drive as it is."""

from itertools import pairwise
from xml.etree import ElementTree

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.proving_ground.parked import plates_of
from floatref_conformance.proving_ground.scenario import MANOEUVRES, Scenario
from floatref_conformance.render.drawing import draw, drawing_svg
from floatref_conformance.render.places import events, join_stretches, speed_along

AXIS = 8
"""Columns left of the plot."""
EVENTFUL = {"braking", "near-stop", "stop", "coasting", "throttle", "dead-start"}
SPEEDS = {
    "creeping": {"speed_kmh": 4.0, "event_speed_kmh": 9.0},
    "throttle": {"speed_kmh": 40.0, "final_speed_kmh": 70.0},
}


def scenario(manoeuvre, **changes):
    return Scenario(manoeuvre=manoeuvre, **{**SPEEDS.get(manoeuvre, {}), **changes})


def rows(lines):
    """Return the rows of the plot, left out the axis and what is below."""
    return [line[AXIS:] for line in lines if line[AXIS - 1 : AXIS] == "|"]


@pytest.mark.parametrize("manoeuvre", MANOEUVRES)
def test_every_manoeuvre_fits_a_terminal_and_a_page(manoeuvre):
    stretches = ((150.0, 190.0), (220.0, 380.9), (390.0, 391.0), (395.0, 396.0))
    lines = draw(scenario(manoeuvre, bump_mm=20.0, bump_at_m=130.0), stretches)
    assert len(lines) <= 18
    assert all(len(line) <= 88 and line.isascii() for line in lines)
    ElementTree.fromstring(drawing_svg(scenario(manoeuvre), "name", stretches))


@settings(max_examples=25, deadline=None)
@given(st.integers(30, 110), st.integers(20, 80), st.integers(300, 420))
@example(30, 20, 404)
def test_a_stop_touches_the_ground_where_it_lies_and_nowhere_else(initial, final, at):
    stop = scenario("stop", speed_kmh=initial, final_speed_kmh=final, event_at_m=at, length_m=700.0)
    lines = draw(stop)
    ground = rows(lines)[-1]
    (mark,) = [line.index("^") for line in lines if "stop," in line]
    assert ground[mark - AXIS] == "*"
    assert "*" not in ground[: mark - AXIS - 8] + ground[mark - AXIS + 8 :]
    assert str(at) in next(line for line in lines if "stop," in line)


def test_the_speed_falls_from_left_to_right_while_a_vehicle_coasts():
    plot = rows(draw(scenario("coasting")))
    height = [
        min(k for k, row in enumerate(plot) if row[column : column + 1] == "*")
        for column in range(70)
    ]
    assert height == sorted(height)
    assert height[0] < height[-1]


def test_every_stop_of_several_is_marked():
    places = events(scenario("stop", stops=3, stop_spacing_m=300.0, length_m=1200.0))
    assert [place.start_m for place in places] == pytest.approx([316.0, 616.0, 916.0])


@pytest.mark.parametrize("manoeuvre", MANOEUVRES)
def test_an_event_lies_where_the_speed_begins_or_ceases_to_change(manoeuvre):
    asked = scenario(manoeuvre)
    kind = RUNS[manoeuvre].kind if manoeuvre in RUNS else manoeuvre
    found = events(asked)
    assert bool(found) == (kind in EVENTFUL)
    if found and kind not in ("dead-start", "coasting", "throttle"):
        distance, speed = speed_along(asked)
        before = speed[(distance > found[0].start_m - 20) & (distance <= found[0].start_m)]
        assert before[0] > before[-1]


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 30), st.integers(0, 9)).map(lambda p: (p[0], sum(p)))))
def test_stretches_are_joined_where_they_overlap_and_nothing_else_is(stretches):
    apart = join_stretches(stretches)
    assert all(one[1] < other[0] for one, other in pairwise(apart))
    for x in range(79):
        inside = [any(a <= x / 2 <= b for a, b in found) for found in (stretches, apart)]
        assert inside[0] == inside[1]


@pytest.mark.parametrize("manoeuvre", ["stop", "bounce"])
def test_what_is_scored_is_marked_where_it_lies(manoeuvre):
    asked = scenario(manoeuvre)
    factor = 1.0 if manoeuvre == "stop" else 1.0 / 20.0
    labels = [f"scored, {factor * a:.4g} to {factor * b:.4g}" for a, b in ((150, 190), (250, 300))]
    lines = draw(asked, ((250.0, 300.0), (150.0, 190.0)))
    assert [line.strip(" [=]") for line in lines if "scored" in line] == labels
    said = ElementTree.fromstring(drawing_svg(asked, "name", ((150.0, 190.0),))).find("desc").text
    assert f"S{labels[0][1:].replace(',', ':')}." in said
    assert not any("scored" in line for line in draw(asked))


def test_a_parked_vehicle_is_drawn_over_time_with_its_plates_and_its_bounce():
    lines = draw(scenario("bounce"))
    assert any(line.lstrip().startswith("s 0") for line in lines)
    assert any("pushed" in line and "10 to 16.5" in line for line in lines)
    for track, plate in plates_of(scenario("bounce")).items():
        (row,) = [line for line in lines if f"plate, {track}" in line]
        assert f"{plate.start_m / 20:.4g}" in row


def test_the_picture_tells_in_words_what_it_shows():
    root = ElementTree.fromstring(drawing_svg(scenario("stop", bump_mm=20.0, bump_at_m=130.0)))
    said = root.find("desc").text
    assert "Stop: 316" in said
    assert "Bump of 20 mm: 128.5 to 131.5" in said
