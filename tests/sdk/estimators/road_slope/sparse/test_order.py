"""Unknowns are eliminated in the order in which the vehicle leaves them behind."""

import numpy as np
from hypothesis import given, settings
from tests.sdk.estimators.road_slope.short_runs import RUNS, Run, at_speed, draw

from floatref.estimators.road_slope.layout import GLOBALS, IN_TIME

few = settings(deadline=None, max_examples=8)


@few
@given(run=RUNS)
def test_every_unknown_is_eliminated_once_and_those_of_the_vehicle_last(run: Run) -> None:
    stretch = draw(run).ours
    order, size = stretch.order, stretch.layout.size
    np.testing.assert_array_equal(np.sort(order), np.arange(size))
    np.testing.assert_array_equal(np.sort(order[-len(GLOBALS) :]), np.arange(size)[-len(GLOBALS) :])


@few
@given(run=RUNS)
def test_nodes_are_in_order_and_a_point_follows_all_that_touch_it(run: Run) -> None:
    stretch = draw(run).ours
    lay, place = stretch.layout, np.argsort(stretch.order)
    for name in IN_TIME:
        assert (np.diff(place[lay.in_time(name)]) > 0).all()
    for under in (stretch.under_laser, *stretch.car.wheels):
        nodes, points = under.nonzero()
        assert (place[lay.elevation][points] > place[lay.pitch][nodes]).all()
    nodes, points = stretch.under_laser.nonzero()
    assert (place[lay.slope][points] > place[lay.pitch][np.maximum(nodes - 1, 0)])[nodes > 0].all()


def test_the_front_does_not_grow_with_the_length_of_the_run() -> None:
    """Nor in a standstill: three nodes, and the road from the front axle to the rear one."""
    long = [at_speed(np.full(nodes, 10.0)).elimination.width for nodes in (150, 300)]
    assert long[0] == long[1]
    stop = np.concatenate([np.full(100, 10.0), np.zeros(100), np.full(100, 10.0)])
    assert at_speed(stop).elimination.width <= 1.3 * long[0]
    assert long[0] < 100
