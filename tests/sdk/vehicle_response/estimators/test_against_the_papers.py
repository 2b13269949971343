"""Matrices, discretization and outputs against the reference, from drawn parameters."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.vehicle_response import (
    IMINE_TRAILER,
    ZHU_HALF_CAR,
    Hold,
    Kind,
    Reading,
    discretize,
    join_at_speed,
    output_matrices,
    state_space,
)
from floatref_reference.imine import section_2_trailer
from floatref_reference.zhu_2021 import (
    section_2_vehicle,
    section_3_discretization,
    section_3_state_space,
)
from floatref_reference.zhu_2021.symbols import Structure

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(deadline=None, max_examples=25)
STEP = 1 / 200


def close(found, wanted):
    """Hold ``found`` to ``wanted`` within 1e-9 of the largest element of each row."""
    size = np.abs(wanted).max(axis=-1, keepdims=True)
    assert found.shape == wanted.shape
    assert (np.abs(found - wanted) <= 1e-9 * size).all()


def zhu(p):
    """Return the reference's vehicle with the parameters ``p`` of a half car."""
    car = section_2_vehicle.HalfCar(
        L_1=p.rear_axle_m,
        L_2=p.front_axle_m,
        e=p.eccentricity_m,
        m_1=p.equipment_kg,
        m_2=p.body_kg,
        m_3=p.rear_wheel_kg,
        m_4=p.front_wheel_kg,
        J_2=p.pitch_kg_m2,
        k_3=p.equipment_n_per_m,
        k_4=p.suspension_n_per_m,
        k_5=p.tyre_n_per_m,
        c_3=p.equipment_ns_per_m,
        c_4=p.suspension_ns_per_m,
    )
    return section_2_vehicle.structure_of_equations(car)


def trailer(p):
    """Return the reference's trailer with the parameters ``p``, in the same order there."""
    return section_2_trailer.motion(section_2_trailer.Trailer(*vars(p).values()))


def structures(parameters):
    """Return half car and trailer, each with (M, C, K, S) of the reference."""
    half, two = parameters[1:]
    m, b, k, c, _ = trailer(two)
    pushed = (c != 0).astype(np.float64)
    return [(half.model(), zhu(half)), (two.model(), Structure(m, b, k, pushed))]


@pytest.mark.cites("(2) to (7) of Zhu", "(2) to (7) of Imine")
@laws
@given(seed=SEEDS)
def test_half_car_and_trailer_have_the_matrices_of_the_equations(seed, drawn_parameters):
    for model, (mass, damping, stiffness, pushed) in structures(drawn_parameters(seed)):
        close(model.mass, mass)
        close(model.damping, damping)
        close(model.stiffness, stiffness)
        np.testing.assert_array_equal(model.selection, pushed)


@pytest.mark.cites("Table 1 of Zhu")
def test_the_constants_are_those_of_the_reference():
    printed = section_2_vehicle.structure()
    model = ZHU_HALF_CAR.model()
    close(model.stiffness, printed.K)
    close(model.damping, printed.C)
    assert section_2_trailer.Trailer(*vars(IMINE_TRAILER).values()) == section_2_trailer.TRAILER


@pytest.mark.cites("(7) of Imine")
@laws
@given(seed=SEEDS)
def test_a_road_pushes_as_in_the_equations_of_the_trailer(seed, drawn_parameters):
    parameters = drawn_parameters(seed)[2]
    model, (_, _, _, height, rate) = parameters.model(), trailer(parameters)
    close(model.selection * [t.stiffness for t in model.tyres], height)
    close(model.selection * [t.damping for t in model.tyres], rate)


@pytest.mark.cites("(9) of Zhu", "(12) of Zhu")
@laws
@given(seed=SEEDS, hold=st.sampled_from(Hold))
def test_states_are_carried_as_by_precise_integration(seed, hold, drawn_parameters):
    for model, vehicle in structures(drawn_parameters(seed)):
        a, b = section_3_state_space.state_space(vehicle)
        for found, wanted in zip(state_space(model), (a, b), strict=True):
            close(found, wanted)
        system = discretize(model, STEP, hold)
        transition, whole, ramp = section_3_discretization.first_order_hold(a, b, STEP)
        close(system.transition, transition)
        if hold is Hold.ZERO_ORDER:
            close(system.before, section_3_discretization.zero_order_hold(a, b, STEP)[1])
            continue
        close(system.before, whole - ramp)
        close(system.after, ramp)


@pytest.mark.cites("(10) of Zhu", "(11) of Zhu")
@laws
@given(seed=SEEDS)
def test_readings_are_those_of_the_selection_matrices(seed, drawn_parameters):
    rng = np.random.default_rng(seed)
    for model, vehicle in structures(drawn_parameters(seed)):
        names = [freedom.name for freedom in model.freedoms]
        kinds, places = rng.choice(list(Kind), 6), rng.integers(0, 5, (6, 2))
        readings = [
            Reading(kind, names[of], 1.0, names[minus] if minus != of else "")
            for kind, (of, minus) in zip(kinds, places, strict=True)
        ]
        chosen = np.zeros((3, 6, 5))
        for row, (kind, (of, minus)) in enumerate(zip(kinds, places, strict=True)):
            chosen[kind.value, row, of] += 1.0
            if minus != of:
                chosen[kind.value, row, minus] -= 1.0
        displaced, moving, accelerated = chosen
        wanted = section_3_state_space.output_matrices(vehicle, accelerated, moving, displaced)
        for found, expected in zip(output_matrices(model, readings), wanted, strict=True):
            close(found, expected)


@pytest.mark.cites("(8) of Zhu")
def test_the_rear_tyre_comes_as_much_later_as_in_the_reference():
    # (8) at a speed that makes the delay 200 samples: nothing is read between two of them.
    speed, step = ZHU_HALF_CAR.wheelbase_m, 1 / 200
    front = np.random.default_rng(0).normal(size=1000)
    rear = section_2_vehicle.rear_road(front, step, speed)
    axles, known = [tyre.x_m for tyre in ZHU_HALF_CAR.model().tyres], np.ones(1000)
    untold = np.full(1000, np.nan)
    by_rear, _ = join_at_speed([rear, untold], [known, known], axles, speed, step)
    by_front, _ = join_at_speed([untold, front], [known, known], axles, speed, step)
    both = np.isfinite(by_rear) & np.isfinite(by_front)
    both[:200] = False
    assert both.sum() > 600
    np.testing.assert_allclose(by_rear[both], by_front[both], atol=1e-9)
