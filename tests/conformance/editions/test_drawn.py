"""What an edition draws: within its ends, in whole steps, and simplified to the simplest."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref_conformance import EDITIONS
from floatref_conformance.editions.drawn import Drawn, Roads
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.proving_ground.scenario import Scenario

SIMPLE = Drawn(-0.3, 0.3, 0.005, 0.105)
ROADS = {
    f"{name}-{key}": road for name in EDITIONS for key, road in find_edition(name).roads.items()
}


@st.composite
def ranges(draw):
    """Return a number to draw whose ends and simplest value are any."""
    step = draw(st.sampled_from([0.005, 0.1, 0.5, 5.0]))
    first, count = draw(st.integers(-60, 60)), draw(st.integers(0, 120))
    low, high = round(first * step, 6), round((first + count) * step, 6)
    return Drawn(low, high, step, round(draw(st.integers(-80, 80)) * step, 6))


def base_of(drawn):
    """Return the value from which steps count: the one nearest to the simplest."""
    return min(max(drawn.simplest, drawn.low), drawn.high)


def agrees(drawn, value):
    steps = (value - base_of(drawn)) / drawn.step
    return drawn.low <= value <= drawn.high and steps == pytest.approx(round(steps), abs=1e-6)


@given(ranges(), st.integers(0, 2**32))
@settings(max_examples=200, deadline=None)
def test_a_value_lies_within_the_ends_in_whole_steps_from_the_simplest(drawn, seed):
    assert agrees(drawn, drawn.draw(np.random.default_rng(seed)))


@given(st.data())
@settings(max_examples=100, deadline=None)
def test_the_strategy_has_the_same_values(data):
    drawn = data.draw(ranges())
    assert agrees(drawn, data.draw(drawn.strategy()))


@pytest.mark.parametrize("drawn", [Drawn(3.0, 12.0, 0.5, 3.0), Drawn(-1.0, 1.0, 0.1), SIMPLE])
def test_both_ends_and_all_between_are_drawn(drawn):
    source = np.random.default_rng(1)
    found = {drawn.draw(source) for _ in range(4000)}
    assert len(found) == round((drawn.high - drawn.low) / drawn.step) + 1
    assert (min(found), max(found)) == (drawn.low, drawn.high)


@pytest.mark.parametrize(
    ("drawn", "simplest"),
    [
        (Drawn(3.0, 12.0, 0.5, 3.0), 3.0),
        (Drawn(4.0, 9.0, 0.5), 4.0),
        (Drawn(-9.0, -2.0, 0.5), -2.0),
        (Drawn(-20.0, 20.0, 0.5, 7.5), 7.5),
        (SIMPLE, 0.105),
    ],
)
def test_hypothesis_begins_with_the_simplest_value_and_so_shrinks_to_it(drawn, simplest):
    found = []

    @settings(database=None, max_examples=1, phases=[Phase.generate])
    @given(drawn.strategy())
    def first(value):
        found.append(value)

    first()
    assert found == [simplest]


@pytest.mark.parametrize("roads", ROADS.values(), ids=ROADS)
def test_the_roads_of_cases_are_of_every_kind_and_within_their_roughness(roads):
    drawn = [roads.draw_for(Scenario(), (7, n)) for n in range(200)]
    assert {scenario.road for scenario in drawn} == set(roads.kinds)
    values = [scenario.iri_m_per_km for scenario in drawn]
    assert (min(values), max(values)) == (roads.smoothest, roads.roughest)
    assert len({scenario.seed for scenario in drawn}) == len(drawn)
    assert roads.draw_for(Scenario(), (7, 3)) == drawn[3]


def test_a_road_leaves_the_rest_of_its_drive():
    stated = Scenario(manoeuvre="stop", slip_percent_per_g=7.0, crown_mm=50.0)
    drawn = Roads(1.0, 2.0, ("measured",)).draw_for(stated, (1,))
    road = {name: getattr(stated, name) for name in ("seed", "road", "iri_m_per_km")}
    assert replace(drawn, **road) == stated
