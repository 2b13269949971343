"""The two-wheel trailer of Imine et al., (1)-(7)."""

from dataclasses import asdict, dataclass

from floatref.vehicle_response.models.connections import (
    Connection,
    check_inertia,
    check_parameters,
    connect,
)
from floatref.vehicle_response.models.model import Freedom, Tyre, VehicleModel

TRAILER = "two-wheel-trailer"
MAY_BE_ZERO = ("coupling_n_per_m", "left_tyre_ns_per_m", "right_tyre_ns_per_m")


@dataclass(frozen=True)
class Trailer:
    """Parameters of a chassis on two wheels beside each other.

    The paper prints no values: the defaults are round numbers of ours for such a trailer.

    Attributes:
        left_wheel_kg: m1.
        right_wheel_kg: m2.
        chassis_kg: m.
        roll_kg_m2: I_x of the chassis.
        pitch_kg_m2: I_y of the chassis.
        left_suspension_n_per_m: k1.
        right_suspension_n_per_m: k2.
        left_tyre_n_per_m: k3.
        right_tyre_n_per_m: k4.
        coupling_n_per_m: k_c between the wheels, or 0.
        left_suspension_ns_per_m: B1.
        right_suspension_ns_per_m: B2.
        left_tyre_ns_per_m: B3, or 0.
        right_tyre_ns_per_m: B4, or 0.
        half_track_m: l, from the middle to a wheel.
        axle_m: p, from the centre of the chassis back to the axle; of any sign.
    """

    left_wheel_kg: float = 40.0
    right_wheel_kg: float = 40.0
    chassis_kg: float = 600.0
    roll_kg_m2: float = 250.0
    pitch_kg_m2: float = 500.0
    left_suspension_n_per_m: float = 30e3
    right_suspension_n_per_m: float = 30e3
    left_tyre_n_per_m: float = 190e3
    right_tyre_n_per_m: float = 190e3
    coupling_n_per_m: float = 5e3
    left_suspension_ns_per_m: float = 1500.0
    right_suspension_ns_per_m: float = 1500.0
    left_tyre_ns_per_m: float = 300.0
    right_tyre_ns_per_m: float = 300.0
    half_track_m: float = 0.75
    axle_m: float = 0.6

    def __post_init__(self) -> None:
        """Refuse impossible parameters; InputError names parameter, value and unit."""
        check_parameters(TRAILER, asdict(self), MAY_BE_ZERO, any_sign=("axle_m",))
        breadth = 2.0 * self.half_track_m
        check_inertia(TRAILER, "roll_kg_m2", self.roll_kg_m2, self.chassis_kg, breadth)

    def model(self, left: str = "left", right: str = "right") -> VehicleModel:
        """Return the model of (2) to (6) of Imine: q = (z1, z2, z, θ, φ), F of left and right tyre.

        Both angles are positive against roll and pitch of a recording: θ lowers the left side, φ
        lifts the nose. K is singular: without a hitch no spring holds z = p·φ. (3) of Imine
        prints -k2·l·θ and -B2·l·θ', which (5) contradicts; both are added here. The wheels run in
        the wheel paths ``left`` and ``right``.
        """
        masses = [
            (Freedom("left wheel", "z1", "unsprung", track=left), self.left_wheel_kg),
            (Freedom("right wheel", "z2", "unsprung", track=right), self.right_wheel_kg),
            (Freedom("chassis", "z", "sprung"), self.chassis_kg),
            (Freedom("roll", "θ", "roll", angular=True, sign=-1.0), self.roll_kg_m2),
            (Freedom("pitch", "φ", "pitch", angular=True, sign=-1.0), self.pitch_kg_m2),
        ]
        back = -self.axle_m
        tyres = [
            Tyre("left wheel", self.left_tyre_n_per_m, self.left_tyre_ns_per_m, back, left),
            Tyre("right wheel", self.right_tyre_n_per_m, self.right_tyre_ns_per_m, back, right),
        ]
        return connect(TRAILER, masses, tyres, self._connections())

    def _connections(self) -> list[Connection]:
        near_left = self.left_suspension_n_per_m, self.left_suspension_ns_per_m
        near_right = self.right_suspension_n_per_m, self.right_suspension_ns_per_m
        across, back = self.half_track_m, self.axle_m
        return [
            Connection((1.0, 0.0, -1.0, across, back), *near_left),
            Connection((0.0, 1.0, -1.0, -across, back), *near_right),
            Connection((1.0, -1.0, 0.0, 0.0, 0.0), self.coupling_n_per_m),
        ]


IMINE_TRAILER = Trailer()
"""Round numbers of ours for the trailer of Imine et al., who print no numbers."""
