"""The manoeuvres of the proving ground as drives; their events lie where they are asked for.

All of them start at distance 0 and end at ``length_m``. Speeds are in m/s, decelerations and
accelerations in m/s² and positive, places in m of true distance.
"""

from collections.abc import Sequence
from itertools import cycle

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground.drives.drive import Drive, Segment
from floatref_conformance.proving_ground.drives.phases import (
    brake,
    brake_to_stop,
    cruise,
    extent,
    set_off,
    speed_change,
)

ENGINE_DRAG = 0.03 * STANDARD_GRAVITY
"""Deceleration of a vehicle coasting in gear, in m/s²."""
SLOW_COAST_DRAG = 0.048 * STANDARD_GRAVITY
"""Deceleration of the paper's coast after a near stop: 5.8 m in 2.19 s from 11.4 km/h (5.2)."""
THROTTLE = 0.15 * STANDARD_GRAVITY
"""Acceleration of a brisk throttle, in m/s²."""
RESTART = 0.25 * STANDARD_GRAVITY
"""Greatest acceleration of a vehicle setting off, in m/s²."""
WANDER_S = (14.0, 18.0, 12.0, 20.0, 16.0)
"""Times in s from slowest to fastest and back of a creeping vehicle, over and over."""


def _up_to(length_m: float, initial_speed: float, segments: Sequence[Segment]) -> Drive:
    """Return the drive ended by a stretch of constant speed up to ``length_m``."""
    distance, speed = extent(initial_speed, segments)
    return Drive(
        initial_speed, (*segments, cruise(speed, length_m - distance, "the end of the drive"))
    )


def constant(speed: float, length_m: float) -> Drive:
    """Drive at constant speed."""
    return _up_to(length_m, speed, ())


def coasting(
    initial_speed: float,
    final_speed: float,
    event_m: float,
    length_m: float,
    drag: float = ENGINE_DRAG,
) -> Drive:
    """Lift the throttle at ``event_m`` and coast from one speed to another, then hold that."""
    before = cruise(initial_speed, event_m, "the start of the coast")
    return _up_to(
        length_m, initial_speed, (before, *speed_change(initial_speed, final_speed, drag))
    )


def throttle(
    initial_speed: float,
    final_speed: float,
    event_m: float,
    length_m: float,
    acceleration: float = THROTTLE,
) -> Drive:
    """Press the throttle at ``event_m``, speed up, and hold the final speed."""
    before = cruise(initial_speed, event_m, "the start of the throttle")
    return _up_to(
        length_m, initial_speed, (before, *speed_change(initial_speed, final_speed, acceleration))
    )


def braking(
    initial_speed: float,
    final_speed: float,
    mean_deceleration: float,
    release_m: float,
    length_m: float,
) -> Drive:
    """Brake so as to reach ``final_speed`` and release the brake, abruptly, at ``release_m``."""
    slowing = brake(initial_speed, final_speed, mean_deceleration)
    distance, _ = extent(initial_speed, slowing)
    before = cruise(initial_speed, release_m - distance, "the release of the brake")
    return _up_to(length_m, initial_speed, (before, *slowing))


def near_stop(
    initial_speed: float,
    slow_speed: float,
    mean_deceleration: float,
    release_m: float,
    coast_s: float,
    final_speed: float,
    length_m: float,
    drag: float = SLOW_COAST_DRAG,
) -> Drive:
    """Brake to ``slow_speed``, released at ``release_m``; coast, then take up ``final_speed``.

    The release leaves the drag at once, since nothing else slows the vehicle. A final speed
    below that after the coast is reached by the drag too, coming and going gently.
    """
    slowing = brake(initial_speed, slow_speed, mean_deceleration)
    distance, _ = extent(initial_speed, slowing)
    before = cruise(initial_speed, release_m - distance, "the release of the brake")
    coast = Segment(coast_s, -drag)
    _, slowest = extent(slow_speed, (coast,))
    if final_speed < slowest:
        after = speed_change(slowest, final_speed, drag)
    else:
        after = set_off(slowest, final_speed, RESTART)
    return _up_to(length_m, initial_speed, (before, *slowing, coast, *after))


def stops(
    initial_speed: float,
    mean_deceleration: float,
    stops_m: Sequence[float],
    dwell_s: float,
    final_speed: float,
    length_m: float,
    acceleration: float = RESTART,
) -> Drive:
    """Brake to a standstill at each of ``stops_m``, stand for ``dwell_s``, set off again.

    The mean deceleration is that of `phases.brake_to_stop`. After every stop the vehicle
    reaches ``final_speed``, from which the next brake starts. InputError if a stop lies too
    close behind the one before.
    """
    if not dwell_s >= 0:
        raise InputError(f"dwell is {dwell_s} s; it must not be negative")
    segments: tuple[Segment, ...] = ()
    place, speed = 0.0, initial_speed
    for stop_m in stops_m:
        slowing = brake_to_stop(speed, mean_deceleration)
        distance, _ = extent(speed, slowing)
        before = cruise(speed, stop_m - place - distance, f"the stop at {stop_m} m")
        restart = set_off(0.0, final_speed, acceleration)
        segments += (before, *slowing, Segment(dwell_s), *restart)
        place, speed = stop_m + extent(0.0, restart)[0], final_speed
    return _up_to(length_m, initial_speed, segments)


def stop(
    initial_speed: float,
    mean_deceleration: float,
    stop_m: float,
    dwell_s: float,
    final_speed: float,
    length_m: float,
    acceleration: float = RESTART,
) -> Drive:
    """Brake to one standstill at ``stop_m``, stand for ``dwell_s``, set off again."""
    return stops(
        initial_speed, mean_deceleration, (stop_m,), dwell_s, final_speed, length_m, acceleration
    )


def dead_start(
    dwell_s: float, final_speed: float, length_m: float, acceleration: float = RESTART
) -> Drive:
    """Stand at distance 0 for ``dwell_s``, then set off and hold ``final_speed``."""
    if not dwell_s >= 0:
        raise InputError(f"dwell is {dwell_s} s; it must not be negative")
    return _up_to(length_m, 0.0, (Segment(dwell_s), *set_off(0.0, final_speed, acceleration)))


def creeping(slowest: float, fastest: float, length_m: float) -> Drive:
    """Creep with a speed that wanders slowly between two speeds, from the slowest on.

    Each half wave of `WANDER_S` takes its acceleration up and down at constant jerk. The
    drive ends with the first half wave that reaches ``length_m``.
    """
    if not 0 < slowest < fastest:
        raise InputError(
            f"creeping from {slowest} to {fastest} m/s: speeds must be above 0, rising"
        )
    segments: list[Segment] = []
    distance, sign = 0.0, 1.0
    for half_s in cycle(WANDER_S):
        if distance >= length_m:
            break
        peak = sign * 2 * (fastest - slowest) / half_s
        jerk = 2 * peak / half_s
        segments += [Segment(half_s / 2, 0.0, jerk), Segment(half_s / 2, peak, -jerk)]
        distance += half_s * (slowest + fastest) / 2
        sign = -sign
    return Drive(slowest, tuple(segments))
