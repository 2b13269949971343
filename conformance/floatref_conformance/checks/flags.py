"""The lengths that a device flags: at the ends of the run, and around its events."""

from collections.abc import Sequence

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of

SLOW_MPS = 16 / 3.6
"""Speed in m/s, 16 km/h, below which any length may be flagged."""
EVENT_LIMITS: Limits = {
    DeviceClass.NOMINAL: 125.0,
    DeviceClass.ADEQUATE: 10.0,
    DeviceClass.REFERENCE: 5.0,
}
"""Largest flagged length around an event in m; 47 m before and 76 m behind a stop (3.3.7)."""
END_LIMITS: Limits = {
    DeviceClass.NOMINAL: 106.0,
    DeviceClass.ADEQUATE: 106.0,
    DeviceClass.REFERENCE: 53.0,
}
"""Largest flagged length at an end in m: a cut-off wavelength, or half of it."""
STEP_S = 0.01
"""Time step in s of the true speed."""


def speed_at(scenario: Scenario, distance_m: FloatArray) -> FloatArray:
    """Return the lowest true speed in m/s at each of the true distances ``distance_m``."""
    drive = drive_of(scenario)
    times = np.arange(0.0, drive.duration_s + STEP_S, STEP_S)
    motion = drive.motion(times)
    return np.interp(distance_m, motion.distance, motion.speed)


def measure_flags(
    compared: Compared, scenario: Scenario, events_m: Sequence[float]
) -> tuple[Measurement, ...]:
    """Return the longest flagged length at an end, and around one of ``events_m``, in m.

    Flagged points connected to an end belong to the end, unless an event lies within them. All
    others belong to the nearest event; without events their total length is returned. Points
    driven below 16 km/h do not count.
    """
    fast = speed_at(scenario, compared.distance_m) >= SLOW_MPS
    x, bad = compared.distance_m, ~compared.valid
    at_ends = [_at_end(bad, x, events_m), _at_end(bad[::-1], x[::-1], events_m)[::-1]]
    ends = [compared.interval_m * float(np.sum(end & fast)) for end in at_ends]
    around = bad & fast & ~(at_ends[0] | at_ends[1])
    places = np.array(events_m or [float(x.mean())])
    nearest = np.argmin(np.abs(x[around][:, None] - places[None, :]), axis=1)
    lengths = compared.interval_m * np.bincount(nearest, minlength=places.size)
    return (
        _length("flagged at an end", compared.track, max(ends), END_LIMITS),
        _length("flagged around an event", compared.track, float(lengths.max()), EVENT_LIMITS),
    )


def _length(quantity: str, track: str, length_m: float, limits: Limits) -> Measurement:
    return Measurement(quantity, track, length_m, "m", limits, is_flagged_length=True)


def _at_end(bad: BoolArray, x: FloatArray, events_m: Sequence[float]) -> BoolArray:
    """Return the flagged points connected to the first one, up to the first event at most."""
    count = bad.size if bad.all() else int(np.argmin(bad))
    piece = np.zeros(bad.size, dtype=np.bool_)
    piece[:count] = True
    for event in events_m:
        if abs(event - x[0]) <= abs(x[max(count - 1, 0)] - x[0]):
            longest = END_LIMITS[DeviceClass.NOMINAL]
            piece &= np.abs(x - x[0]) <= min(longest, abs(event - x[0]) / 2)
    return piece
