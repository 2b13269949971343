"""Samples of an accelerometer on a wheel or body that is stuck within its range."""

import numpy as np

from floatref.architectures.damage import Damage, Runs, Usual, merged, told
from floatref.architectures.stuck import STUCK, TRAVEL_M, travel
from floatref.values.recording import Channel

SHORTEST = 3
STUCK_S = 0.02
"""No accelerometer on a vehicle that drives repeats itself for so long, unless it is coarse or
slow and does so all the time."""


def stuck_force(channel: Channel, distance: Channel) -> Damage:
    """Return where an accelerometer repeats itself while ``distance`` goes on.

    That is for 20 ms, for so many times the usual hold of its other samples, and over 0.5 m.
    What follows is disturbed as by a gap, since acceleration is integrated.
    """
    shortest = max(SHORTEST, int(STUCK_S * channel.mean_rate_hz))
    runs = Runs.of(channel.values, shortest)
    if not runs.first.size:
        return Damage()
    usual = Usual.of(channel.values)
    unusual = [length >= STUCK * usual.beside(length) for length in runs.length.tolist()]
    spans = runs.spans[np.array(unusual, dtype=np.bool_)]
    spans = spans[np.array([_goes_on(channel, distance, *s) for s in spans.tolist()], np.bool_)]
    if not spans.size:
        return Damage()
    return Damage(spans, spans, warnings=(told(channel, spans, "stuck"),))


def together(first: Damage, second: Damage) -> Damage:
    """Return the damage of both."""
    return Damage(
        merged(np.concatenate([first.gone, second.gone])),
        merged(np.concatenate([first.lasting, second.lasting])),
        merged(np.concatenate([first.void, second.void])),
        (*first.warnings, *second.warnings),
    )


def _goes_on(channel: Channel, distance: Channel, first: int, behind: int) -> bool:
    begin, end = channel.clock.times(2, first)[0], channel.clock.times(1, behind - 1)[0]
    return travel(distance, float(begin), float(end)) >= TRAVEL_M
