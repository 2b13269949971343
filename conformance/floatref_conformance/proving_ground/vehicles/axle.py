"""One axle of a vehicle: where it is, its wheels, springs, dampers and tyres."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Axle:
    """One axle; stiffness, damping, friction and mass are of one of its two wheels.

    Attributes:
        x_m: position ahead of the body's centre of gravity, in m.
        half_track_m: lateral position of the left wheel, in m.
        wheel_kg: unsprung mass, in kg.
        spring, tyre: stiffness at the wheel, in N/m.
        damper: in N·s/m.
        anti_roll: of the bar, in N per m of difference between the sides' travel.
        friction: force at which the spring's leaves slide, in N.
        progression: p of the spring's force k·d·(1 + p·d²), in 1/m²; d is from rest on level
            ground.
    """

    x_m: float
    half_track_m: float
    wheel_kg: float
    spring: float
    damper: float
    tyre: float
    anti_roll: float = 0.0
    friction: float = 0.0
    progression: float = 0.0
