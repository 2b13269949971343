"""Friction and progression as a scenario gives them, and what a whole simulation makes of them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.staging import vehicle_of
from floatref_conformance.proving_ground.vehicles.full_car import Vehicle
from floatref_conformance.proving_ground.vehicles.parameter_sets import (
    LINEAR_MODELS,
    VEHICLES,
    find_vehicle,
    with_springs,
)


@given(
    name=st.sampled_from(sorted(VEHICLES)),
    friction_nm=st.floats(1.0, 10000.0),
    progression=st.floats(0.0, 1000.0),
)
def test_both_axles_bear_the_moment_of_the_friction(
    name: str, friction_nm: float, progression: float
) -> None:
    """A moment alone loads one axle as it relieves the other: two corners of M / (2·L) each."""
    vehicle = with_springs(VEHICLES[name], friction_nm, progression)
    front, rear = vehicle.axles
    assert 2 * front.friction == pytest.approx(2 * rear.friction)
    moment = 2 * (front.friction * front.x_m - rear.friction * rear.x_m)
    assert moment == pytest.approx(friction_nm)
    assert front.progression == rear.progression == progression
    assert vehicle.make_setup() == VEHICLES[name].make_setup()


def test_a_scenario_without_either_drives_the_parameter_set_itself() -> None:
    assert vehicle_of(Scenario()) is VEHICLES["loaded-van"]
    assert vehicle_of(Scenario(friction_nm=5.0)) == find_vehicle("loaded-van", 5.0)
    found = vehicle_of(Scenario(progression_per_m2=30.0, vehicle="pickup"))
    assert isinstance(found, Vehicle)
    assert found.rear.progression == 30.0


@pytest.mark.parametrize("name", list(LINEAR_MODELS))
@pytest.mark.parametrize("field", ["friction_nm", "progression_per_m2"])
def test_a_papers_model_takes_neither(name: str, field: str) -> None:
    assert vehicle_of(Scenario(vehicle=name)) is LINEAR_MODELS[name]
    with pytest.raises(InputError, match=f"vehicle {name} is a paper's linear model; leave"):
        Scenario(vehicle=name, **{field: 1.0})


@pytest.mark.parametrize(
    ("field", "value"),
    [("friction_nm", 10001.0), ("friction_nm", -1.0), ("progression_per_m2", 2e3)],
)
def test_options_beyond_their_limits_are_refused(field: str, value: float) -> None:
    with pytest.raises(InputError, match=f"{field} is {value:.0f}.*must lie between 0 and"):
        Scenario(**{field: value})


@pytest.mark.parametrize("field", ["friction", "progression"])
def test_an_axle_of_less_than_no_friction_is_refused(field: str) -> None:
    vehicle = VEHICLES["minivan"]
    with pytest.raises(InputError, match=f"rear.{field} is -1.0; it must be 0 or above"):
        replace(vehicle, rear=replace(vehicle.rear, **{field: -1.0}))


def stopped(**changes: float) -> Simulation:
    return simulate(
        Scenario(
            road="flat",
            manoeuvre="stop",
            speed_kmh=20.0,
            event_at_m=20.0,
            length_m=25.0,
            final_speed_kmh=5.0,
            dwell_s=8.0,
            sensors=0.0,
            rate_hz=2000.0,
            **changes,
        )
    )


def test_pitch_stays_while_the_vehicle_stands() -> None:
    """And with it the deflection that the recording measures."""
    pitch, deflection = {}, {}
    for friction_nm in (0.0, 2500.0):
        simulation = stopped(friction_nm=friction_nm)
        motion = simulation.motion
        standing = np.flatnonzero(motion.speed == 0.0)
        late = standing[3 * standing.size // 4 :]
        pitch[friction_nm] = motion.pitch[late]
        seen = simulation.recording.channel("suspension_deflection", "left")
        part = slice(*(int(motion.times_s[k] * float(seen.clock.rate)) for k in late[[0, -1]]))
        deflection[friction_nm] = np.abs(seen.values[part]).mean()
    assert np.abs(pitch[0.0]).max() < 1e-6
    assert np.abs(pitch[2500.0]).min() > 2e-4
    assert np.ptp(pitch[2500.0]) < 0.05 * np.abs(pitch[2500.0]).mean()
    assert deflection[2500.0] > 2e-4 > 10 * deflection[0.0]
