"""Names of the channels that stages make out of the measured ones.

All of them belong to a track, in SI units.
"""

ACCELERATION = "vertical_acceleration"
"""Vertical acceleration of the reference point, 1 g removed, in m/s²."""
VELOCITY = "vertical_velocity"
"""Its integral, in m/s."""
REFERENCE_HEIGHT = "floating_reference_height"
"""The second integral, in m."""
HEIGHT = "height"
"""Range from the reference point to the road, in m."""
ELEVATION = "elevation"
"""Floating reference height minus height, in m."""
DISTANCE = "distance"
"""Encoder distance in m; shared by all tracks."""
TIME = "time"
"""Time of a trigger in s after the first sample; shared by all tracks."""
TIME_STEP = "time_step"
"""Time in s from the trigger before; shared by all tracks."""
