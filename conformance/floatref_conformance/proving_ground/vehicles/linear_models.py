"""The models of the response papers, and a quarter car, written from their equations.

Zhu et al. (2021): half car with equipment, (2)-(7). Imine et al.: two-wheel trailer, (2)-(7). An
estimator that is tested on these knows nothing of this module, and it nothing of an estimator.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.proving_ground.vehicles.plain_model import (
    Contact,
    Coordinate,
    PlainModel,
    Travel,
)

ZHU_TABLE_1: Mapping[str, float] = MappingProxyType(
    {
        "equipment_kg": 1000.0,
        "body_kg": 13000.0,
        "rear_wheel_kg": 170.0,
        "front_wheel_kg": 170.0,
        "pitch_kg_m2": 124566.0,
        "equipment_n_per_m": 1e6,
        "suspension_n_per_m": 2.5e6,
        "tyre_n_per_m": 1.434e6,
        "equipment_ns_per_m": 790.0,
        "suspension_ns_per_m": 1200.0,
        "rear_axle_m": 3.19,
        "front_axle_m": 6.19,
        "eccentricity_m": 1.5,
    }
)
"""m₁ to m₄, I, k₃ to k₅, c₃, c₄, L₁, L₂, e; the table prints the dampers as 0.79 and 0.0012 N·s/m,
which damp nothing, and which are read as 790 and 1200 N·s/m."""
TRAILER: Mapping[str, float] = MappingProxyType(
    {
        "left_wheel_kg": 40.0,
        "right_wheel_kg": 40.0,
        "chassis_kg": 600.0,
        "roll_kg_m2": 250.0,
        "pitch_kg_m2": 500.0,
        "left_suspension_n_per_m": 30e3,
        "right_suspension_n_per_m": 30e3,
        "left_tyre_n_per_m": 190e3,
        "right_tyre_n_per_m": 190e3,
        "coupling_n_per_m": 5e3,
        "left_suspension_ns_per_m": 1500.0,
        "right_suspension_ns_per_m": 1500.0,
        "left_tyre_ns_per_m": 300.0,
        "right_tyre_ns_per_m": 300.0,
        "half_track_m": 0.75,
        "axle_m": 0.6,
    }
)
"""m₁, m₂, m, Ix, Iy, k₁ to k₄, kc, B₁ to B₄, l, p: not in the paper; round numbers."""


def quarter_car(
    sprung_kg: float, unsprung_kg: float, spring: float, damper: float, tyre: float
) -> PlainModel:
    """Return a corner of a car on its wheel; in kg, N/m and N·s/m."""
    parameters = {
        "sprung_kg": sprung_kg,
        "unsprung_kg": unsprung_kg,
        "suspension_n_per_m": spring,
        "suspension_ns_per_m": damper,
        "tyre_n_per_m": tyre,
        "tyre_ns_per_m": 0.0,
    }
    coupled = np.array([[1.0, -1.0], [-1.0, 1.0]])
    return PlainModel(
        name="quarter-car",
        coordinates=(
            Coordinate("sprung", sprung_kg, y_m=0.0),
            Coordinate("unsprung", unsprung_kg, y_m=0.0),
        ),
        tyres=(Contact(1, tyre),),
        paper_damping=damper * coupled,
        paper_stiffness=spring * coupled + np.diag([0.0, tyre]),
        suspensions=(Travel("suspension_deflection", (1.0, -1.0), 0.0),),
        setup=VehicleSetup("quarter-car", parameters),
        sensor_x_m=0.0,
        cg_height_m=0.6,
        antenna_m=(0.0, 0.0, 1.5),
    )


def half_car_with_equipment() -> PlainModel:
    """Return the truck of Table 1 of Zhu, (2) to (6) of Zhu in y₁, y₂, y₃, y₄ and θ (nose up).

    Each axle has two springs and dampers, k₄ and c₄, and one tyre, k₅.
    """
    m1, m2, m3, m4, i, k3, k4, k5, c3, c4, l1, l2, e = ZHU_TABLE_1.values()
    stiffness = np.array(_zhu(k3, k4, l1, l2, e)) + np.diag([0.0, 0.0, k5, k5, 0.0])
    return PlainModel(
        name="zhu-half-car",
        coordinates=(
            Coordinate("equipment", m1, y_m=0.0),
            Coordinate("sprung", m2, y_m=0.0),
            Coordinate("rear_unsprung", m3, y_m=0.0),
            Coordinate("unsprung", m4, y_m=0.0),
            Coordinate("pitch", i, sign=-1.0),
        ),
        tyres=(Contact(2, k5, x_m=-l1), Contact(3, k5, x_m=l2)),
        paper_damping=np.array(_zhu(c3, c4, l1, l2, e)),
        paper_stiffness=stiffness,
        suspensions=(
            Travel("suspension_deflection", (0.0, 1.0, 0.0, -1.0, l2), 0.0),
            Travel("rear_suspension_deflection", (0.0, 1.0, -1.0, 0.0, -l1), 0.0),
        ),
        setup=VehicleSetup("half-car-with-equipment", ZHU_TABLE_1),
        sensor_x_m=-4.4,
        cg_height_m=1.5,
        antenna_m=(0.0, 0.0, 3.2),
    )


def _zhu(of3: float, of4: float, l1: float, l2: float, e: float) -> list[list[float]]:
    """Return C or K of (7) of Zhu without the tyres, of c₃ and c₄ or of k₃ and k₄.

    C₃₃ is printed with the wrong sign; (4) has it right.
    """
    heave_pitch = e * of3 + 2 * l2 * of4 - 2 * l1 * of4
    pitch = e**2 * of3 + 2 * l1**2 * of4 + 2 * l2**2 * of4
    return [
        [of3, -of3, 0.0, 0.0, -e * of3],
        [-of3, of3 + 4 * of4, -2 * of4, -2 * of4, heave_pitch],
        [0.0, -2 * of4, 2 * of4, 0.0, 2 * l1 * of4],
        [0.0, -2 * of4, 0.0, 2 * of4, -2 * l2 * of4],
        [-e * of3, heave_pitch, 2 * l1 * of4, -2 * l2 * of4, pitch],
    ]


def two_wheel_trailer() -> PlainModel:
    """Return the trailer, (2) to (6) of Imine in z₁, z₂, z, θ (left down) and φ (nose up).

    The paper leaves the hitch out, so that the chassis may turn about its axle, z = p·φ, without a
    spring: it is thrown about its axle as a road lifts it, and its momentum of that motion stays
    zero. The printed sign of k₂·l·θ in (3) is a slip: (5) has it right.
    """
    m1, m2, m, ix, iy, k1, k2, k3, k4, kc, b1, b2, b3, b4, half, p = TRAILER.values()
    wheels = np.zeros((5, 5))
    wheels[:2, :2] = [[k3 + kc, -kc], [-kc, k4 + kc]]
    return PlainModel(
        name="imine-trailer",
        coordinates=(
            Coordinate("unsprung", m1, y_m=half),
            Coordinate("unsprung", m2, y_m=-half),
            Coordinate("sprung", m),
            Coordinate("roll", ix, sign=-1.0),
            Coordinate("pitch", iy, sign=-1.0),
        ),
        tyres=(Contact(0, k3, b3, -p, half), Contact(1, k4, b4, -p, -half)),
        paper_damping=np.array(_imine(b1, b2, half, p)) + np.diag([b3, b4, 0.0, 0.0, 0.0]),
        paper_stiffness=np.array(_imine(k1, k2, half, p)) + wheels,
        suspensions=(
            Travel("suspension_deflection", (-1.0, 0.0, 1.0, -half, -p), half),
            Travel("suspension_deflection", (0.0, -1.0, 1.0, half, -p), -half),
        ),
        setup=VehicleSetup("two-wheel-trailer", TRAILER),
        sensor_x_m=-1.2,
        cg_height_m=0.7,
        antenna_m=(0.0, 0.0, 1.9),
    )


def _imine(one: float, two: float, half: float, p: float) -> list[list[float]]:
    """Return B or K of (7) of Imine without tyres and coupling, of B₁ and B₂ or of k₁ and k₂."""
    both, apart = one + two, two - one
    return [
        [one, 0.0, -one, one * half, one * p],
        [0.0, two, -two, -two * half, two * p],
        [-one, -two, both, apart * half, -both * p],
        [one * half, -two * half, apart * half, both * half**2, -apart * half * p],
        [one * p, two * p, -both * p, -apart * half * p, both * p**2],
    ]


QUARTER_CAR = quarter_car(400.0, 40.0, 22e3, 1800.0, 200e3)
"""Round numbers of a car's corner: the body bounces at 1.1 Hz, the wheel hops at 11 Hz."""
ZHU_HALF_CAR = half_car_with_equipment()
IMINE_TRAILER = two_wheel_trailer()
