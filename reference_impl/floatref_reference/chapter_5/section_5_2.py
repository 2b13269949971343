"""5.2 Test Conditions: the runs of Tables 5.1 and 5.2, transcribed."""

from typing import NamedTuple

import numpy as np

from floatref_reference.signals import STANDARD_GRAVITY


class StopAndGo(NamedTuple):
    """A run that stops, entered at 72 km/h and left at 58 km/h.

    Args:
        designation: name of the run in Tables 5.3 to 5.12.
        deceleration: average between 70.5 km/h and 0.5 km/h, g.
        duration: time at standstill, s.
        location: place of the stop from the start of the test section, m.
    """

    designation: str
    deceleration: float
    duration: float
    location: float


class Braking(NamedTuple):
    """A run that brakes without a stop.

    Args:
        designation: name of the run in Tables 5.3 to 5.12.
        deceleration: average while braking, g.
        v_0: speed at which the brakes were applied, km/h.
        v_1: speed at which they were released, km/h.
        location: place of the release from the start of the test section, m.
    """

    designation: str
    deceleration: float
    v_0: float
    v_1: float
    location: float


TABLE_5_1 = (
    StopAndGo("S&G, 1.1-sec stop, 0.17 g", 0.171, 1.07, 215.1),
    StopAndGo("S&G, 1.1-sec stop, 0.20 g", 0.203, 1.12, 216.1),
    StopAndGo("S&G, 2.1-sec stop, 0.33 g", 0.329, 2.10, 216.6),
    StopAndGo("S&G, 5.8-sec stop, 0.17 g", 0.167, 5.77, 214.6),
    StopAndGo("S&G, 5.7-sec stop, 0.20 g", 0.202, 5.69, 215.4),
    StopAndGo("S&G, 5.8-sec stop, 0.20 g", 0.201, 5.78, 216.5),
    StopAndGo("S&G, 10.7-sec stop, 0.20 g", 0.200, 10.70, 216.5),
)
"""Table 5.1."""

TABLE_5_2 = (
    Braking("Brk, 71-30 km/hr, 0.19 g", 0.195, 71.4, 29.9, 213.0),
    Braking("Brk, 72-29 km/hr, 0.39 g", 0.390, 71.8, 29.1, 201.2),
    Braking("Brk, 49-22 km/hr, 0.16 g", 0.163, 49.1, 22.1, 220.2),
    Braking("Brk, 49-23 km/hr, 0.18 g", 0.178, 49.3, 23.2, 221.4),
    Braking("Brk, 49-20 km/hr, 0.25 g", 0.248, 49.1, 19.6, 217.6),
    Braking("Brk, 49-23 km/hr, 0.18 g", 0.178, 49.2, 22.7, 218.6),
    Braking("Brk, 49-34 km/hr, 0.84 g", 0.842, 48.8, 34.1, 197.6),
    Braking("NS, 72-11 km/hr, 0.20 g", 0.196, 71.6, 11.4, 215.1),
)
"""Table 5.2, with the near stop's speeds from the text: 44.5-7.1 in the table are mph."""


def braking_distance(run: Braking) -> np.longdouble:
    """Compute how far a run travels while it brakes.

    Equation:
        Section 5.2: (v_0² - v_1²) / (2 a), for a deceleration a that is steady.

    Args:
        run: row of Table 5.2.

    Returns:
        Distance from the first touch of the brakes to their release, m.
    """
    v_0, v_1 = (np.longdouble(v) / np.longdouble("3.6") for v in (run.v_0, run.v_1))
    return (v_0**2 - v_1**2) / (2 * np.longdouble(run.deceleration) * STANDARD_GRAVITY)
