"""Stages, architectures and measures for inertial road profilers.

Units are SI throughout: metres, seconds, radians, m/s². Angular rates are right-handed.
Body axes (ISO 8855): X forward, Y left, Z up. Pitch is a rotation about +Y, nose down
positive; roll is a rotation about +X, left side up positive; the order is yaw, pitch, roll.
Braking gives a negative longitudinal acceleration and a positive pitch.

`vertical_specific_force` is what an accelerometer along body Z reads: +9.80665 m/s² at rest
and level. `height` is the range from the reference point down to the road, positive. The
profile is the floating reference height minus the height.

Time is an integer sample index with a rational rate; distance is an integer point index with
a constant interval. Arrays of values are one-dimensional, float64 and read-only; NaN means
missing. IRI is in m/km.
"""

__version__ = "0.1.0"
