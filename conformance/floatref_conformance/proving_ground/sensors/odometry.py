"""Further sensors of distance: an encoder on each side, and a second source that is no encoder.

A typical profiler has one encoder on one wheel. That of the dissertation has one on the rear wheel
of each side, "without the bias associated with driving on a curve" (4.1.1), an optical fifth wheel,
the wheel speeds of the vehicle bus, and GNSS (4.1.3).
"""

from collections.abc import Iterator

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Setup
from floatref_conformance.proving_ground.sensors.chain import Chain, count_steps, sample_rows
from floatref_conformance.proving_ground.sensors.noise import quantize, stream

BUS_FIRST_S = 0.037
"""Time of the first speed on the bus: its clock is not the accelerometers'."""
WALK_M = 0.1
"""The optical wheel's walk takes a step every so many m, and is linear in between."""


def wheel_encoders(chain: Chain, setup: Setup, curvature: float) -> Iterator[Channel]:
    """Yield the encoder of the wheel at every wheel path, each with errors of its own.

    A wheel at y to the left runs 1 - curvature·y of the vehicle's path; the rear wheels stand
    where the accelerometers do (4.2.1).

    Args:
        chain: suite, seed and true motion.
        setup: where the accelerometers sit.
        curvature: of the course, left turn positive, in 1/m.
    """
    suite = chain.suite
    for track, place in setup.tracks.items():
        rng = stream(chain.seed, f"{track}.wheel_distance")
        scale = suite.encoder_scale * rng.uniform(-1.0, 1.0)
        own = 1.0 + suite.wheel_spread * rng.uniform(-1.0, 1.0)
        path = 1.0 - curvature * place.reference_point_m[1]
        yield chain.channel("wheel_distance", chain.count_wheel(scale, path, own), track)


def wheel_speed(chain: Chain, standing: bool = False) -> Channel:
    """Return the speed on the vehicle bus: of wheels that slip and grow as the encoder's does.

    It comes in steps, late, and is 0 below the speed at which wheel sensors are silent.
    ``standing``: the vehicle is parked and its distance an artificial encoder's.
    """
    suite, motion = chain.suite, chain.motion
    times, at = chain.sample_times(BUS_FIRST_S, suite.bus_rate_hz, suite.bus_delay_s)
    speed = np.zeros(times.size) if standing else sample_rows(motion.speed, at)
    slip = suite.slip_per_g / STANDARD_GRAVITY * sample_rows(motion.acceleration, at)
    drawn_scale = suite.bus_scale * stream(chain.seed, "wheel_speed").uniform(-1.0, 1.0)
    speed *= 1.0 + drawn_scale + slip - chain.radius_growth(speed, at / chain.rate_hz)
    speed[speed < suite.bus_silent_mps] = 0.0
    return Channel.of("wheel_speed", quantize(speed, suite.bus_resolution), StampedClock.of(times))


def optical_distance(chain: Chain, standing: bool = False) -> Channel:
    """Return the optical fifth wheel: no slip, a scale error, a walk, and whole counts.

    ``standing``: the vehicle is parked and its distance an artificial encoder's.
    """
    suite, true = chain.suite, chain.motion.distance
    rng = stream(chain.seed, "optical_distance")
    scale = 1.0 + suite.optical_scale * rng.uniform(-1.0, 1.0)
    travel = np.zeros(chain.count) if standing else true * scale
    if suite.optical_walk > 0 and not standing:
        travel += _walk(rng, suite.optical_walk, true)
    return chain.channel("optical_distance", count_steps(travel, suite.optical_step_m))


def _walk(rng: np.random.Generator, density: float, distance: FloatArray) -> FloatArray:
    """Return a walk from 0 that spreads by ``density`` per √m of distance, shape (n,), in m."""
    steps = int(np.ceil(distance[-1] / WALK_M)) + 1
    walk = np.cumsum(density * WALK_M**0.5 * rng.standard_normal(steps))
    knots = WALK_M * np.arange(steps + 1)
    return np.asarray(np.interp(distance, knots, np.concatenate([[0.0], walk])))
