"""A short run that does not exist, for which a pipeline needs all that it ever compiles.

It is the drive of `warming` as a recording: two wheel paths at 16 kHz, whose lasers are beside
their accelerometers, with what else the pipeline reads.
"""

import numpy as np

from floatref.engine.plugins import plugins
from floatref.live.warming import made_up
from floatref.values.arrays import frozen
from floatref.values.axle_setup import AxleSetup
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.installation import Setup, TrackSetup
from floatref.values.needs import DISTANCE, FORCE, HEIGHT
from floatref.values.recording import Channel, Recording
from floatref.values.vehicle_setup import VehicleSetup
from floatref.vehicle_response.needs import FORCE as WHEEL_FORCE

RATE_HZ, RESPONSE_HZ, GNSS, QUALITY = 16_000.0, 1000.0, "gnss_", "gnss_quality"
PATHS = {"left": 0.8, "right": -0.8}
"""Wheel paths and their places in m to the left."""
LASER_AHEAD_M = 0.1
RESPONSE = (WHEEL_FORCE, "sprung_specific_force", "suspension_deflection")
CORNER = {
    "sprung_kg": 700.0,
    "unsprung_kg": 75.0,
    "suspension_n_per_m": 45e3,
    "suspension_ns_per_m": 3300.0,
    "tyre_n_per_m": 320e3,
}
"""A quarter car, whose numbers are those of a passenger car."""


def made_up_recording(pipeline: str) -> Recording:
    """Return the run with the channels that ``pipeline`` reads; InputError if it is unknown."""
    asked = plugins().pipeline(pipeline)
    of_paths = RESPONSE if asked.architecture == "response" else (FORCE, HEIGHT)
    rate_hz = RESPONSE_HZ if asked.architecture == "response" else RATE_HZ
    names = [ChannelId(name, path) for path in PATHS for name in of_paths]
    quality = [QUALITY] if asked.readings else []
    names += [ChannelId(n) for n in (DISTANCE, *asked.channels, *asked.readings, *quality)]
    clocks = {n: None if n.name.startswith(GNSS) else UniformClock.of(rate_hz) for n in names}
    pieces = list(made_up(clocks))
    channels = []
    for name, clock in clocks.items():
        values = frozen(np.concatenate([piece[name].values for piece in pieces]))
        times = [piece[name].times_s for piece in pieces]
        stamps = [each for each in times if each is not None]
        channels.append(Channel(name, values, clock or StampedClock(np.concatenate(stamps))))
    return Recording(tuple(channels), _setup())


def _setup() -> Setup:
    tracks = {
        name: TrackSetup((0.0, left_m, 0.3), (LASER_AHEAD_M, 0.0, 0.0))
        for name, left_m in PATHS.items()
    }
    vehicle = VehicleSetup("quarter-car", CORNER)
    return Setup(tracks=tracks, vehicle=vehicle, axles=AxleSetup(3.0, 1.5))
