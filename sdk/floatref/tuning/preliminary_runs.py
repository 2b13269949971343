"""The kind of a preliminary run by its encoder: speed, brakes and stops (section 6.4.4)."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from floatref.screening.travel import Travel
from floatref.stages.speed import WINDOW_S
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import STANDARD_GRAVITY

LOW_KMH, HIGH_KMH = 12.0, 60.0
"""Constant speeds up to the first are low, from the second on high."""
UNEVEN = 0.4
"""Speeds of a drive at constant speed differ by less than this share of their mean."""
STANDING_MPS = 0.16 / 3.6
LEAST_STOP_S = 0.3
"""Shortest stop in s: in a crawl a coarse encoder also repeats its count for a while."""
LONG_STOP_S = 3.5
"""Stops from here on are long: between the 2 s and the 5 s that are recommended."""
BRAKING_G, RELEASED_G = 0.1, 0.05
"""A brake slows by the first on average, and is released where it slows by less than the second."""
HEAVY_G = 0.25
"""Brakes from here on are heavy: between the 0.2 g and the 0.3 g that are recommended."""
SMOOTHED_S = 0.5


class Kind(StrEnum):
    """The kinds of preliminary runs."""

    LOW = "low speed"
    CONSTANT = "constant speed"
    HIGH = "high speed"
    LIGHT = "light braking"
    HEAVY = "heavy braking"
    SHORT = "short stop"
    LONG = "long stop"
    OTHER = "other"


RECOMMENDED = {
    Kind.LOW: "constant speed of 8 km/h or less",
    Kind.HIGH: "constant speed of 72 km/h or more",
    Kind.LIGHT: "braking at 0.15 to 0.2 g, down to 25 km/h or more",
    Kind.HEAVY: "braking at 0.3 g or more, down to 25 km/h or more",
    Kind.SHORT: "a stop of 2 s or less, from 40 km/h or more at 0.3 g or more",
    Kind.LONG: "a stop of 5 s or more, from 40 km/h or more at 0.2 g or less",
}
"""The six runs that section 6.4.4 recommends at least."""
STEADY = (Kind.LOW, Kind.CONSTANT, Kind.HIGH)
STOPS = (Kind.SHORT, Kind.LONG)


@dataclass(frozen=True)
class Drive:
    """How a run was driven within the stretch that counts.

    Attributes:
        kind: of the run.
        speed_kmh: mean speed over time, stops included.
        deceleration_g: of the hardest brake; 0 without one.
        stop_s: duration of the longest stop.
        critical_m: distances of the stops or, without a stop, of where brakes were released.
    """

    kind: Kind
    speed_kmh: float
    deceleration_g: float
    stop_s: float
    critical_m: tuple[float, ...]


def drive_of(travel: Travel, begin_m: float, end_m: float) -> Drive:
    """Return how the vehicle of ``travel`` was driven between two encoder distances in m.

    A brake that is released there counts, and so does a stop there.
    """
    distance, speed = travel
    smooth = _smooth(speed)
    inside = (distance > begin_m) & (distance < end_m)
    brakes = [
        (mean_g, place) for mean_g, place in _brakes(distance, smooth) if begin_m < place < end_m
    ]
    stops = _stops(distance, speed, inside)
    hardest = max((mean_g for mean_g, _ in brakes), default=0.0)
    longest = max((duration for duration, _ in stops), default=0.0)
    within = smooth[inside] if inside.any() else np.zeros(1)
    places = stops or brakes
    return Drive(
        _kind(within, hardest, longest),
        3.6 * float(within.mean()),
        hardest,
        longest,
        tuple(place for _, place in places),
    )


def _kind(speed: FloatArray, hardest_g: float, longest_s: float) -> Kind:
    if longest_s > 0:
        return Kind.LONG if longest_s >= LONG_STOP_S else Kind.SHORT
    if hardest_g > 0:
        return Kind.HEAVY if hardest_g >= HEAVY_G else Kind.LIGHT
    mean = float(speed.mean())
    if np.ptp(speed) > UNEVEN * mean:
        return Kind.OTHER
    if mean <= LOW_KMH / 3.6:
        return Kind.LOW
    return Kind.HIGH if mean >= HIGH_KMH / 3.6 else Kind.CONSTANT


def _stops(distance: FloatArray, speed: FloatArray, inside: BoolArray) -> list[tuple[float, float]]:
    """Return duration in s and place in m of every stop inside."""
    return [
        ((end - begin) * WINDOW_S, float(distance[begin]))
        for begin, end in stretches((speed < STANDING_MPS) & inside)
        if (end - begin) * WINDOW_S >= LEAST_STOP_S
    ]


def _brakes(distance: FloatArray, smooth: FloatArray) -> list[tuple[float, float]]:
    """Return mean deceleration in g of every brake, and where in m it was released.

    The mean is that of where it is half its peak or more: not of its rise and release.
    """
    if not smooth.size:
        return []
    half = round(SMOOTHED_S / WINDOW_S) // 2
    padded = np.pad(smooth, half, mode="edge")
    slowing = (padded[: -2 * half] - padded[2 * half :]) / (2 * half * WINDOW_S)
    found = []
    for begin, end in stretches(slowing > RELEASED_G * STANDARD_GRAVITY):
        part = slowing[begin:end]
        mean_g = float(part[part >= part.max() / 2].mean()) / STANDARD_GRAVITY
        if mean_g >= BRAKING_G:
            found.append((mean_g, float(distance[end - 1])))
    return found


def _smooth(speed: FloatArray) -> FloatArray:
    """Return the mean speed over half a second around, and of fewer samples at both ends."""
    window = np.ones(round(SMOOTHED_S / WINDOW_S))
    if speed.size < window.size:
        return speed
    sums = np.convolve(speed, window, "same")
    return np.asarray(sums / np.convolve(np.ones(speed.size), window, "same"))


def stretches(where: BoolArray) -> list[tuple[int, int]]:
    """Return the first index of every stretch that is true, and the one behind its last."""
    edges = np.diff(np.concatenate(([False], where, [False])).astype(np.int8))
    begins, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return list(zip(begins.tolist(), ends.tolist(), strict=True))
