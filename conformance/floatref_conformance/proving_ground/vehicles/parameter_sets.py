"""The parameter sets of the proving ground's vehicles.

Wheelbase, track width, weight and sensor position of the loaded van are those of the system
vehicle of Karamihas 2021, section 4.2; what the text lacks, and the other sets, are round
numbers of the vehicle's kind. Pitch under braking is 2 to 5 degrees per g; the body bounces,
pitches and rolls at 1.0 to 2.3 Hz, the wheels hop at 8 to 13 Hz. Beside them stand the linear
models of papers.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref_conformance.proving_ground.vehicles.axle import Axle
from floatref_conformance.proving_ground.vehicles.full_car import Vehicle
from floatref_conformance.proving_ground.vehicles.linear_models import (
    IMINE_TRAILER,
    QUARTER_CAR,
    ZHU_HALF_CAR,
)
from floatref_conformance.proving_ground.vehicles.plain_model import PlainModel
from floatref_conformance.proving_ground.vehicles.suspended import Suspended

LOADED_VAN = Vehicle(
    name="loaded-van",
    sprung_kg=3000.0,
    pitch_inertia=6200.0,
    roll_inertia=1300.0,
    cg_height_m=0.92,
    front=Axle(1.72, 0.86, 75.0, 45e3, 3300.0, 320e3, 14e3),
    rear=Axle(-1.71, 0.86, 100.0, 130e3, 5200.0, 340e3, 6e3),
    anti_dive=0.15,
    roll_links=0.25,
    sensor_x_m=-2.91,
)
"""GMC Savana of 31.49 kN and two occupants; the profiler 1.2 m behind the rear axle.

The load sits on stiff rear springs: they let it swing at nearly 2 Hz once it stands (section
5.3) and the profiler sink by some 20 mm in the 10.7-s stop (15 to 18 mm in sections 5.10 and 6.6).
"""

MINIVAN = Vehicle(
    name="minivan",
    sprung_kg=1750.0,
    pitch_inertia=3000.0,
    roll_inertia=720.0,
    cg_height_m=0.68,
    front=Axle(1.35, 0.81, 45.0, 29e3, 2300.0, 220e3, 12e3),
    rear=Axle(-1.68, 0.81, 42.0, 27e3, 2100.0, 220e3, 8e3),
    anti_dive=0.2,
    roll_links=0.2,
    sensor_x_m=-0.16,
    antenna_m=(-0.16, 0.0, 1.9),
)
"""The profiler in the middle of the wheelbase."""

PICKUP = Vehicle(
    name="pickup",
    sprung_kg=2150.0,
    pitch_inertia=4600.0,
    roll_inertia=860.0,
    cg_height_m=0.78,
    front=Axle(1.62, 0.87, 60.0, 36e3, 2800.0, 270e3, 14e3),
    rear=Axle(-2.06, 0.87, 95.0, 33e3, 2500.0, 280e3, 2e3),
    anti_dive=0.08,
    roll_links=0.25,
    sensor_x_m=-3.45,
    antenna_m=(-0.3, 0.0, 2.1),
)
"""A mount in the hitch receiver, 1.4 m behind the rear axle."""

TRAILER = Vehicle(
    name="trailer",
    sprung_kg=820.0,
    pitch_inertia=760.0,
    roll_inertia=330.0,
    cg_height_m=0.72,
    front=Axle(1.75, 0.72, 80.0, 16e3, 1300.0, 210e3, 6e3),
    rear=Axle(-0.55, 0.80, 40.0, 33e3, 2000.0, 190e3),
    anti_dive=0.1,
    roll_links=0.3,
    sensor_x_m=-1.25,
    antenna_m=(-0.4, 0.0, 1.9),
    response_axle=1,
)
"""One axle; the front pair stands for the hitch, borne by the tow vehicle's rear wheels.

The sensors of its response are on its own axle, the rear one.
"""

SOFT_VAN = Vehicle(
    name="soft-van",
    sprung_kg=2100.0,
    pitch_inertia=4700.0,
    roll_inertia=950.0,
    cg_height_m=0.9,
    front=Axle(1.45, 0.84, 55.0, 25e3, 800.0, 240e3, 11e3),
    rear=Axle(-1.60, 0.84, 70.0, 25e3, 750.0, 240e3, 5e3),
    anti_dive=0.0,
    roll_links=0.15,
    sensor_x_m=-3.0,
)
"""Soft springs, worn dampers, and the profiler 1.4 m behind the rear axle."""

VEHICLES: Mapping[str, Vehicle] = MappingProxyType(
    {v.name: v for v in (LOADED_VAN, MINIVAN, PICKUP, TRAILER, SOFT_VAN)}
)
"""The whole vehicles by name: all that a check or a table drives."""

LINEAR_MODELS: Mapping[str, PlainModel] = MappingProxyType(
    {model.name: model for model in (ZHU_HALF_CAR, IMINE_TRAILER, QUARTER_CAR)}
)
"""The models of papers by name: they answer to the road alone, and neither brake nor corner."""


def find_vehicle(name: str, friction_nm: float = 0.0, progression_per_m2: float = 0.0) -> Suspended:
    """Return the parameter set ``name``, a vehicle's or a model's, with `with_springs` applied.

    Raises InputError if it is unknown, or for friction or progression in a model of a paper.
    """
    if name in VEHICLES:
        return with_springs(VEHICLES[name], friction_nm, progression_per_m2)
    if name in LINEAR_MODELS:
        if friction_nm or progression_per_m2:
            raise InputError(
                f"vehicle {name} is a paper's linear model; leave friction_nm and "
                f"progression_per_m2 at 0, or choose from {', '.join(VEHICLES)}"
            )
        return LINEAR_MODELS[name]
    known = (*VEHICLES, *LINEAR_MODELS)
    raise InputError(f"vehicle {name}: unknown; {suggest(name, known, 'known:')}")


def with_springs(vehicle: Vehicle, friction_nm: float, progression_per_m2: float) -> Vehicle:
    """Return ``vehicle`` with friction and progressive springs at all four corners.

    Args:
        vehicle: its axles get other friction and progression.
        friction_nm: moment M about pitch in N·m at which the suspension slides. A moment alone
            loads one axle with M / wheelbase and relieves the other by as much, so that both
            slide at M with M / (2·wheelbase) at every corner, wherever the centre of gravity
            is. Our figure for leaf springs is 1000 to 2500 N·m: in the loaded van 150 to 360 N,
            2 to 5 % of a corner's load.
        progression_per_m2: p of k·d·(1 + p·d²), whose stiffness is k·(1 + 3·p·d²). 10 to 100 is
            realistic: with 14 the stiffness has risen by a third at 0.09 m, as much as that of
            a coil spring rises from rebound to bump (38.4 kN/m over 75 mm, 50.5 over 90 mm:
            rear axle of a Volvo XC90 in the vehicle data of Vector DYNA4 4.0), and with 100 it
            has doubled at 0.058 m, as where a bump stop of rubber takes part.
    """
    if not (friction_nm or progression_per_m2):
        return vehicle
    changes = {
        "friction": friction_nm / (2 * vehicle.wheelbase_m),
        "progression": progression_per_m2,
    }
    front, rear = (replace(axle, **changes) for axle in vehicle.axles)
    return replace(vehicle, front=front, rear=rear)
