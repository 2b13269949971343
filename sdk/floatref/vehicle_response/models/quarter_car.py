"""A quarter car: a body on one suspension, wheel and tyre."""

from dataclasses import asdict, dataclass

from floatref.vehicle_response.models.connections import Connection, check_parameters, connect
from floatref.vehicle_response.models.model import Freedom, Tyre, VehicleModel

QUARTER_CAR = "quarter-car"


@dataclass(frozen=True)
class QuarterCar:
    """Parameters of one corner of a vehicle, with the coordinates "body" and "wheel".

    Attributes:
        sprung_kg: mass of the body on this wheel.
        unsprung_kg: mass of the wheel and its carrier.
        suspension_n_per_m: stiffness of spring and bushings.
        suspension_ns_per_m: damping.
        tyre_n_per_m: stiffness of the tyre.
        tyre_ns_per_m: its damping, or 0.
    """

    sprung_kg: float
    unsprung_kg: float
    suspension_n_per_m: float
    suspension_ns_per_m: float
    tyre_n_per_m: float
    tyre_ns_per_m: float = 0.0

    def __post_init__(self) -> None:
        """Refuse impossible parameters; InputError names parameter, value and unit."""
        check_parameters(QUARTER_CAR, asdict(self), not_below_zero=("tyre_ns_per_m",))

    def model(self, track: str = "") -> VehicleModel:
        """Return the model with q = (body, wheel); its tyre runs in wheel path ``track``."""
        body = Freedom("body", "z_s", "sprung", track=track)
        wheel = Freedom("wheel", "z_u", "unsprung", track=track)
        tyre = Tyre("wheel", self.tyre_n_per_m, self.tyre_ns_per_m, track=track)
        stroke = Connection((1.0, -1.0), self.suspension_n_per_m, self.suspension_ns_per_m)
        masses = [(body, self.sprung_kg), (wheel, self.unsprung_kg)]
        return connect(QUARTER_CAR, masses, [tyre], [stroke])
