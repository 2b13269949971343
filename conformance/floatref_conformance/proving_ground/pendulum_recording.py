"""The inverted pendulum as a profiler: what its sensors measure, as a recording."""

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.proving_ground.vehicles.pendulum import PendulumMotion


def pendulum_recording(motion: PendulumMotion, profile_interval_m: float = 0.00508) -> Recording:
    """Return the recording of ideal sensors fixed in the pendulum's body, on a flat road.

    Their readings are those of (2.23) to (2.25) with gravity as in (2.17), so the tilt of the
    body is the only error. The road is flat: whatever profile comes of it is that error.
    """
    clock = UniformClock.of(1.0 / float(motion.time[1] - motion.time[0]))
    samples = {
        "vertical_specific_force": motion.body_vertical + STANDARD_GRAVITY,
        "longitudinal_specific_force": motion.body_longitudinal,
        "pitch_rate": motion.pitch_rate,
        "height": motion.body_height,
        "distance": motion.trolley.distance,
    }
    channels = tuple(Channel.of(name, values, clock) for name, values in samples.items())
    return Recording(channels, Setup(profile_interval_m), "floatref", "inverted pendulum")
