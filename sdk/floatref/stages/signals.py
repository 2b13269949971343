"""Names of the channels that stages make out of the measured ones.

All are in SI units and belong to a track unless they are said to be shared.
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
TRAVEL_SPEED = "travel_speed"
"""Speed of the vehicle from the encoder, in m/s; shared by all tracks."""
CUTOFF = "high_pass_cutoff"
"""Cut-off of a varying high-pass filter, in Hz on the time axis and in cycles/m on the distance
axis; shared by all tracks."""
TRUE_TIME_STEP = "true_time_step"
"""Time in s from the trigger before, where `time_step` has been adjusted; shared by all tracks."""
