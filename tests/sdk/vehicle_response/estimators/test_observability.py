"""Which sensors are needed, and that the one that is named is the one that is missing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import (
    IMINE_TRAILER,
    ZHU_HALF_CAR,
    Connection,
    Freedom,
    Hold,
    Kind,
    Reading,
    Tyre,
    check_readings,
    connect,
    discretize,
    missing_displacements,
    output_matrices,
    unfelt_tyres,
    unseen_freedoms,
)

STEP = 1 / 200
HALF_CAR, TRAILER = ZHU_HALF_CAR.model(), IMINE_TRAILER.model()
NAMES = [freedom.name for freedom in HALF_CAR.freedoms]
FIVE = [Reading(Kind.ACCELERATION, name, 0.01) for name in NAMES]
HEIGHTS = [Reading(Kind.DISPLACEMENT, name, 1e-3) for name in NAMES]
DEFLECTIONS = [
    Reading(Kind.DISPLACEMENT, "body", 1e-3, minus=name)
    for name in ("equipment", "rear wheel", "front wheel")
]


def drift_of(readings, hold=Hold.ZERO_ORDER, count=4000):
    """Return the road's standard deviation of steps (a)-(c) of Zhu after ``count`` samples."""
    system = discretize(HALF_CAR, STEP, hold)
    output, direct = output_matrices(HALF_CAR, readings)
    j, noise = system.feedthrough(output, direct), np.diag([r.sigma**2 for r in readings])
    p, found = 1e-9 * np.eye(10), []
    for _ in range(count):
        r = np.linalg.inv(output @ p @ output.T + noise)
        force = np.linalg.inv(j.T @ r @ j)
        gain = p @ output.T @ r
        state = p - gain @ (np.linalg.inv(r) - j @ force @ j.T) @ gain.T
        cross = -gain @ j @ force
        both = np.hstack([system.transition, system.input])
        joint = np.block([[state, cross], [cross.T, force]])
        p = both @ joint @ both.T + 1e-12 * np.eye(10)
        p = (p + p.T) / 2
        found.append(np.sqrt(np.trace(force)) / 1.434e6)
    return found[count // 2], found[-1]


@pytest.mark.slow
def test_the_drift_that_is_told_is_that_of_the_filter():
    for readings, drifts in ((FIVE, True), (FIVE + DEFLECTIONS, True), (FIVE + HEIGHTS, False)):
        earlier, later = drift_of(readings)
        assert bool(missing_displacements(HALF_CAR, readings)) == drifts
        assert later > 1.3 * earlier if drifts else later < 1.001 * earlier


@pytest.mark.parametrize("hold", list(Hold))
def test_five_accelerations_drift_and_the_displacements_of_both_wheels_cure_it(hold):
    with pytest.raises(
        InputError,
        match=r"half-car-with-equipment: the readings do not determine all heights and angles at "
        "rest, so the estimate would drift; add the displacement of the rear wheel and the "
        "displacement of the front wheel$",
    ):
        check_readings(HALF_CAR, FIVE, STEP, hold)
    check_readings(HALF_CAR, FIVE + HEIGHTS, STEP, hold)
    check_readings(HALF_CAR, FIVE + HEIGHTS[2:4], STEP, hold)


@pytest.mark.parametrize("others", [DEFLECTIONS, DEFLECTIONS[1:], HEIGHTS[:1], HEIGHTS[4:]])
def test_deflections_or_one_height_or_angle_do_not_cure_it(others):
    with pytest.raises(InputError, match="the estimate would drift"):
        check_readings(HALF_CAR, FIVE + others, STEP)


@pytest.mark.parametrize(
    ("left_out", "named"),
    [
        ({2, 3}, "rear wheel and of the front wheel: .* rear wheel and the acceleration of the f"),
        ({2}, "tyre of the rear wheel: .*; add the acceleration of the rear wheel$"),
        ({3}, "tyre of the front wheel: .*; add the acceleration of the front wheel$"),
    ],
)
@pytest.mark.parametrize("hold", list(Hold))
def test_a_tyre_that_no_accelerometer_feels_is_named(left_out, named, hold):
    readings = [r for at, r in enumerate(FIVE) if at not in left_out] + HEIGHTS
    with pytest.raises(InputError, match=named):
        check_readings(HALF_CAR, readings, STEP, hold)


def test_a_difference_of_both_wheels_feels_neither():
    difference = Reading(Kind.ACCELERATION, "rear wheel", 0.01, minus="front wheel")
    readings = [difference, *FIVE[:2], *HEIGHTS]
    assert unfelt_tyres(HALF_CAR, readings) == ("rear wheel", "front wheel")
    assert unfelt_tyres(HALF_CAR, [*readings, FIVE[3]]) == ()


def test_a_chassis_that_turns_freely_has_to_be_seen():
    wheels = [
        Reading(kind, name, 1e-3)
        for kind in (Kind.ACCELERATION, Kind.DISPLACEMENT)
        for name in ("left wheel", "right wheel")
    ]
    assert unseen_freedoms(TRAILER, wheels, STEP) == ("chassis", "pitch")
    with pytest.raises(InputError, match=r"add the displacement of the chassis$"):
        check_readings(TRAILER, wheels, STEP)
    for name in ("chassis", "pitch"):
        seen = [*wheels, Reading(Kind.DISPLACEMENT, name, 1e-3)]
        assert unseen_freedoms(TRAILER, seen, STEP) == ()
        check_readings(TRAILER, seen, STEP)


def test_an_undamped_motion_that_nothing_tells_is_named():
    freedoms = [(Freedom(name, name, name), 10.0) for name in ("wheel", "one horn", "other horn")]
    horns = [Connection((1.0, -1.0, 0.0), 5e3), Connection((1.0, 0.0, -1.0), 5e3)]
    model = connect("cart", freedoms, [Tyre("wheel", 1e5, 50.0)], horns)
    readings = [Reading(k, "wheel", 1e-3) for k in (Kind.ACCELERATION, Kind.DISPLACEMENT)]
    with pytest.raises(InputError, match="motion of the one horn and the other horn unknown"):
        check_readings(model, readings, STEP)
    check_readings(model, [*readings, Reading(Kind.VELOCITY, "one horn", 1e-3)], STEP)


@pytest.mark.slow
@settings(deadline=None, max_examples=25)
@given(data=st.data())
def test_what_is_named_is_enough(data, drawn_parameters):
    for parameters in drawn_parameters(data.draw(st.integers(0, 2**32 - 1))):
        model = parameters.model()
        every = [Reading(kind, f.name, 0.01) for kind in Kind for f in model.freedoms]
        chosen = data.draw(st.lists(st.sampled_from(every), min_size=1))
        chosen += [Reading(Kind.ACCELERATION, n, 0.01) for n in unfelt_tyres(model, chosen)]
        assert unfelt_tyres(model, chosen) == ()
        named = missing_displacements(model, chosen)
        chosen += [Reading(Kind.DISPLACEMENT, n, 0.01) for n in named]
        assert missing_displacements(model, chosen) == ()
        check_readings(model, chosen, STEP)
        assert np.linalg.matrix_rank(output_matrices(model, chosen)[1]) == len(model.tyres)
