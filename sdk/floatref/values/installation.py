"""Where sensors and axles are on the vehicle, and the interval at which a profile is made."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from floatref.errors import InputError
from floatref.values.axle_setup import AxleSetup
from floatref.values.vehicle_setup import VehicleSetup

Vector = tuple[float, float, float]
ORIGIN: Vector = (0.0, 0.0, 0.0)
SHORTEST_INTERVAL_M = 1e-5
LONGEST_INTERVAL_M = 10.0


def check_interval(interval_m: float, where: str) -> None:
    """Raise InputError naming ``where`` unless a profile can be made at ``interval_m`` in m."""
    if not SHORTEST_INTERVAL_M <= interval_m <= LONGEST_INTERVAL_M:
        raise InputError(
            f"{where} is {interval_m:g}; give the profile interval in m, between 0.00001 and 10"
        )


@dataclass(frozen=True)
class TrackSetup:
    """Where one wheel path's sensors sit, in m in body axes: ahead, to the left, up.

    Attributes:
        reference_point_m: the accelerometer, from one point of the vehicle.
        laser_offset_m: the laser, from the accelerometer; (0.105, 0, 0) is 0.105 m ahead of it.
    """

    reference_point_m: Vector = ORIGIN
    laser_offset_m: Vector = ORIGIN


@dataclass(frozen=True)
class Setup:
    """Geometry of the installation and the profile interval, in m, and the vehicle if known.

    ``vehicle`` is its model, for an estimate from its response; ``axles`` are where its wheels are.
    """

    profile_interval_m: float = 0.00508
    gnss_antenna_offset_m: Vector = ORIGIN
    tracks: Mapping[str, TrackSetup] = field(default_factory=dict)
    vehicle: VehicleSetup | None = None
    axles: AxleSetup | None = None

    def __post_init__(self) -> None:
        """Refuse an impossible interval; make the tracks read-only."""
        check_interval(self.profile_interval_m, "setup.profile_interval_m")
        object.__setattr__(self, "tracks", MappingProxyType(dict(self.tracks)))

    def track(self, name: str) -> TrackSetup:
        """Return where the sensors of wheel path ``name`` sit; at the vehicle point if unknown."""
        return self.tracks.get(name, TrackSetup())

    def axles_about(self, track: str) -> AxleSetup:
        """Return the axles, or the usual ones about the accelerometer of ``track`` if unknown."""
        return self.axles or AxleSetup.usual(self.track(track).reference_point_m[0])
