"""Rigid-body kinematics from the body to the sensors, and what each sensor would truly read.

Specific forces are (2.17) with g kept (+9.80665 m/s² along body Z at rest); the range is taken
along body −Z to the road under the footprint, (2.18) for a road that is not flat; angles are
those of (6.23), with respect to the vertical.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import TrackSetup, Vector
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.vehicles.response import grid_of


@dataclass(frozen=True)
class Course:
    """Slopes and curvature of the lane, constant along it.

    Attributes:
        grade_rad: uphill positive, in rad.
        cross_slope_rad: left side up positive, in rad.
        curvature_per_m: left turn positive, in 1/m.
    """

    grade_rad: float = 0.0
    cross_slope_rad: float = 0.0
    curvature_per_m: float = 0.0

    @property
    def up(self) -> Vector:
        """The vertical in the lane's axes: along it, to its left, normal to it."""
        pitch, roll = -self.grade_rad, self.cross_slope_rad
        return -sin(pitch), cos(pitch) * sin(roll), cos(pitch) * cos(roll)

    def ground_force(
        self, speed: FloatArray, acceleration: FloatArray, grade: FloatArray | float = 0.0
    ) -> FloatArray:
        """Return what the ground exerts along and across the lane, shape (2, n), in m/s².

        ``grade`` is the slope of the road's alignment against the lane: gravity pulls the vehicle
        down it, and the ground holds it.
        """
        up = self.up
        along = acceleration + STANDARD_GRAVITY * (up[0] + up[2] * np.sin(np.arctan(grade)))
        return np.stack([along, self.curvature_per_m * up[2] * speed**2 + STANDARD_GRAVITY * up[1]])

    def lane_force(self, speed: FloatArray, acceleration: FloatArray) -> FloatArray:
        """Return `ground_force` and the specific force normal to the lane, shape (3, n)."""
        up = self.up
        normal = STANDARD_GRAVITY * up[2] - self.curvature_per_m * up[1] * speed**2
        return np.stack([*self.ground_force(speed, acceleration), normal])


@dataclass(frozen=True, eq=False)
class Sighted:
    """Geometry that the kinematic kernel needs, of one vehicle's sensors over one road.

    Attributes:
        course: curvature, vertical, g and height of the centre of gravity, shape (6,).
        points: reference points and laser offsets, shape (tracks, 5), in m.
        paths: wheel paths from right to left, shape (paths, m), in m.
        grid: start in m and points per m.
        pairs: the wheel paths beside each track, shape (tracks, 4).
    """

    course: FloatArray
    points: FloatArray
    paths: FloatArray
    grid: FloatArray
    pairs: FloatArray

    @classmethod
    def of(
        cls, course: Course, road: Road, setups: Sequence[TrackSetup], cg_height_m: float
    ) -> "Sighted":
        """Return the geometry of sensors at ``setups``, from the point below the CG."""
        points = [
            (x, y, z - cg_height_m, setup.laser_offset_m[0], setup.laser_offset_m[1])
            for setup in setups
            for x, y, z in [setup.reference_point_m]
        ]
        paths, pairs = _neighbours(road, [p[1] + p[4] for p in points])
        constants = [course.curvature_per_m, *course.up, STANDARD_GRAVITY, cg_height_m]
        return cls(np.array(constants), np.array(points), paths, grid_of(road), pairs)

    def carry(
        self, body: FloatArray, travel: FloatArray, tracks: FloatArray, shared: FloatArray
    ) -> None:
        """Write what the sensors' points do; for the shapes see `kernels.at_points`."""
        from floatref_conformance.proving_ground.kernels import at_points

        at_points(
            body,
            travel,
            self.course,
            self.points,
            self.paths,
            self.grid,
            self.pairs,
            tracks,
            shared,
        )


def _neighbours(road: Road, sides: Sequence[float]) -> tuple[FloatArray, FloatArray]:
    """Return the wheel paths from right to left, and which two lie beside each position."""
    names = road.tracks[::-1]
    if len(names) == 1:
        only = road.elevation[names[0]]
        return np.stack([only, only]), np.array([(0.0, 1.0, 0.0, 0.0)] * len(sides))
    lateral = [road.lateral_m[name] for name in names]
    pairs = []
    for y in sides:
        right = min(max(int(np.searchsorted(lateral, y, side="right")) - 1, 0), len(names) - 2)
        width = lateral[right + 1] - lateral[right]
        pairs.append((float(right), right + 1.0, lateral[right], 1.0 / width))
    return np.stack([road.elevation[name] for name in names]), np.array(pairs)
