"""The half car with equipment of Zhu et al. (2021), (2)-(7) with Table 1."""

from dataclasses import asdict, dataclass

from floatref.vehicle_response.models.connections import (
    Connection,
    check_inertia,
    check_parameters,
    connect,
)
from floatref.vehicle_response.models.model import Freedom, Tyre, VehicleModel

HALF_CAR = "half-car-with-equipment"


@dataclass(frozen=True)
class HalfCar:
    """Parameters of a body with equipment on a rear and a front axle; defaults of Table 1 of Zhu.

    The table prints the damping as 0.79 and 0.0012 N·s/m, which is almost zero: it is read as 790
    and 1200 N·s/m.

    Attributes:
        equipment_kg: m1.
        body_kg: m2.
        rear_wheel_kg: m3.
        front_wheel_kg: m4.
        pitch_kg_m2: I of the body.
        equipment_n_per_m: k3, between body and equipment.
        suspension_n_per_m: k4 of each of the two springs of an axle: an axle has 2·k4.
        tyre_n_per_m: k5 of an axle.
        equipment_ns_per_m: c3.
        suspension_ns_per_m: c4 of each of the two dampers of an axle.
        rear_axle_m: L1, from the centre of the body back to the rear axle.
        front_axle_m: L2, from the centre of the body ahead to the front axle.
        eccentricity_m: e, of the equipment ahead of the centre of the body; of any sign.
    """

    equipment_kg: float = 1000.0
    body_kg: float = 13000.0
    rear_wheel_kg: float = 170.0
    front_wheel_kg: float = 170.0
    pitch_kg_m2: float = 124566.0
    equipment_n_per_m: float = 1e6
    suspension_n_per_m: float = 2.5e6
    tyre_n_per_m: float = 1.434e6
    equipment_ns_per_m: float = 790.0
    suspension_ns_per_m: float = 1200.0
    rear_axle_m: float = 3.19
    front_axle_m: float = 6.19
    eccentricity_m: float = 1.5

    def __post_init__(self) -> None:
        """Refuse impossible parameters; InputError names parameter, value and unit."""
        check_parameters(HALF_CAR, asdict(self), any_sign=("eccentricity_m",))
        check_inertia(HALF_CAR, "pitch_kg_m2", self.pitch_kg_m2, self.body_kg, self.wheelbase_m)

    @property
    def wheelbase_m(self) -> float:
        """L1 + L2 of (8) of Zhu, in m."""
        return self.rear_axle_m + self.front_axle_m

    def model(self) -> VehicleModel:
        """Return the model of (2) to (6) of Zhu: q = (y1, y2, y3, y4, θ), F of rear and front tyre.

        θ is positive with the nose up, against the pitch of a recording. C has +2·c4 for the
        rear wheel, as in (4) of Zhu and unlike (7).
        """
        masses = [
            (Freedom("equipment", "y1", "equipment"), self.equipment_kg),
            (Freedom("body", "y2", "sprung"), self.body_kg),
            (Freedom("rear wheel", "y3", "rear_unsprung"), self.rear_wheel_kg),
            (Freedom("front wheel", "y4", "unsprung"), self.front_wheel_kg),
            (Freedom("pitch", "θ", "pitch", angular=True, sign=-1.0), self.pitch_kg_m2),
        ]
        tyres = [
            Tyre("rear wheel", self.tyre_n_per_m, x_m=-self.rear_axle_m),
            Tyre("front wheel", self.tyre_n_per_m, x_m=self.front_axle_m),
        ]
        return connect(HALF_CAR, masses, tyres, self._connections())

    def _connections(self) -> list[Connection]:
        axle = 2.0 * self.suspension_n_per_m, 2.0 * self.suspension_ns_per_m
        carried = self.equipment_n_per_m, self.equipment_ns_per_m
        return [
            Connection((1.0, -1.0, 0.0, 0.0, -self.eccentricity_m), *carried),
            Connection((0.0, 1.0, -1.0, 0.0, -self.rear_axle_m), *axle),
            Connection((0.0, 1.0, 0.0, -1.0, self.front_axle_m), *axle),
        ]


ZHU_HALF_CAR = HalfCar()
"""Table 1 of Zhu et al. (2021), damping read as 790 and 1200 N·s/m."""
