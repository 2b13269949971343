"""Where the axles are: what the slope of the road under the vehicle is the slope of."""

from dataclasses import dataclass
from math import isfinite

from floatref.errors import InputError

SHORTEST_M = 0.5
LONGEST_M = 20.0
FARTHEST_M = 100.0
"""No axle is farther from the vehicle point, in m."""
USUAL_WHEELBASE_M = 3.43
"""Wheelbase of the system vehicle of Karamihas (2021), section 4.2 (135 in), in m."""
USUAL_FRONT_M = 4.63
"""Its front axle ahead of its accelerometers, which are 1.2 m behind the rear axle, in m."""


@dataclass(frozen=True)
class AxleSetup:
    """The axles that carry the body on which the sensors are.

    A vehicle with more than two counts the middle of each group as an axle; a trailer's front one
    is its hitch.

    Attributes:
        wheelbase_m: distance between the axles, in m.
        front_axle_m: front axle ahead of the vehicle point, from which all offsets are, in m.
    """

    wheelbase_m: float
    front_axle_m: float

    def __post_init__(self) -> None:
        """Refuse what is no vehicle; InputError names the field."""
        if not SHORTEST_M <= self.wheelbase_m <= LONGEST_M:
            raise InputError(
                f"setup.axles.wheelbase_m is {self.wheelbase_m:g}; give it in m, "
                f"between {SHORTEST_M:g} and {LONGEST_M:g}"
            )
        if not (isfinite(self.front_axle_m) and abs(self.front_axle_m) <= FARTHEST_M):
            raise InputError(
                f"setup.axles.front_axle_m is {self.front_axle_m:g}; give it in m, within 100 m"
            )

    @property
    def rear_axle_m(self) -> float:
        """Rear axle ahead of the vehicle point, in m."""
        return self.front_axle_m - self.wheelbase_m

    @classmethod
    def usual(cls, accelerometer_m: float) -> "AxleSetup":
        """Return the axles of the system vehicle of section 4.2 about an accelerometer.

        They stand in for unknown ones. ``accelerometer_m`` is its place ahead of the vehicle point.
        """
        return cls(USUAL_WHEELBASE_M, accelerometer_m + USUAL_FRONT_M)
