"""Kernels and modules of a pipeline, loaded by a short drive before the first sample comes.

The first window of a stream would otherwise load them while samples come: up to a hundred compiled
functions, each of which holds the interpreter for milliseconds, or for a second where it has still
to be compiled. The drive is made up: a body that bounces over a few waves, brakes to a standstill
and goes on. What comes of it is thrown away, and so is a refusal of it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from math import ceil, pi

import numpy as np

from floatref.errors import FloatrefError
from floatref.live.declared_channels import Piece
from floatref.live.following import Following, Order
from floatref.values.arrays import FloatArray, frozen
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.clock import UniformClock
from floatref.values.encoder.plausible_distance import DISTANCES
from floatref.values.needs import VERTICAL_FORCES

SPEED_MPS, CHANGE = 16.0, 4.0
"""Speed in m/s before and behind the stop, and the change of speed there in m/s²."""
STOPS_S, STANDS_S, LASTS_S = 8.0, 2.0, 17.0
"""Middle and length of the stop, and length of the drive, in s."""
WAVES_M = (2.3, 7.0, 19.0)
BOUNCE_HZ, BOUNCE_M = 1.3, 0.001
STEP_S = 0.01
TIMED_HZ = 20.0
"""Rate in Hz of a channel whose samples have times."""
LIKELY = {"gnss_quality": 4.0, "gnss_latitude": 0.7, "gnss_longitude": 0.1}
SPEEDS = ("gnss_speed", "wheel_speed")
EXACT = (*DISTANCES, *LIKELY)
NOISE = 1e-5
"""1-σ of the noise of all sensors but those, in the unit of each."""


def warm(order: Order, provisional: bool) -> None:
    """Load what a stream of this ``order`` needs, once in a process for channels of these names."""
    names = tuple(str(name) for name in order.clocks)
    timed = tuple(clock is None for clock in order.clocks.values())
    if (order.pipelines[:1], names, timed, provisional) not in _warmed():
        _warmed().add((order.pipelines[:1], names, timed, provisional))
        drive(order, provisional)


def drive(order: Order, provisional: bool) -> int:
    """Pass the drive through a stream of this ``order``, and return the number of its points.

    The pipeline may refuse the drive; there are no points then.
    """
    following, count = Following(replace(order, pipelines=order.pipelines[:1]), provisional), 0
    try:
        for pieces in made_up(order.clocks):
            count += sum(map(len, following.push(pieces)))
        return count + sum(map(len, following.finish()))
    except FloatrefError:
        return 0


def made_up(clocks: Mapping[ChannelId, UniformClock | None]) -> Iterator[dict[ChannelId, Piece]]:
    """Yield the samples of the drive, a second at a time, on these ``clocks``."""
    rng = np.random.default_rng(0)
    for second in range(ceil(LASTS_S)):
        pieces = {}
        for name, clock in clocks.items():
            start_s = 0.0 if clock is None else clock.start_s
            rate_hz = TIMED_HZ if clock is None else float(clock.rate)
            ends = [ceil((second + k) * rate_hz) for k in (0, 1)]
            times = np.arange(*ends) / rate_hz
            values = _samples(name, times)
            if name.name not in EXACT:
                values = values + NOISE * rng.standard_normal(times.size)
            pieces[name] = Piece(frozen(values), None if clock else frozen(start_s + times))
        yield pieces


def _samples(name: ChannelId, times: FloatArray) -> FloatArray:
    omega = 2.0 * pi * BOUNCE_HZ
    bounce = BOUNCE_M * np.sin(omega * times)
    along = np.arange(0.0, LASTS_S + 1.0, STEP_S)
    speed = np.clip(CHANGE * (np.abs(along - STOPS_S) - 0.5 * STANDS_S), 0.0, SPEED_MPS)
    way = np.interp(times, along, np.cumsum(speed) * STEP_S)
    if name.name in DISTANCES:
        return np.asarray(np.maximum.accumulate(way))
    if name.name in SPEEDS:
        return np.interp(times, along, speed)
    if name.name in VERTICAL_FORCES:
        return np.asarray(STANDARD_GRAVITY - omega**2 * bounce)
    if name.name == "height":
        road = sum(1e-4 * wave * np.sin(2.0 * pi * way / wave) for wave in WAVES_M)
        return np.asarray(0.3 + bounce - road)
    if name.name == "longitudinal_specific_force":
        return np.interp(times, along, np.gradient(speed, STEP_S))
    return np.full(times.size, LIKELY.get(name.name, 0.0))


@cache
def _warmed() -> set[tuple[tuple[str, ...], tuple[str, ...], tuple[bool, ...], bool]]:
    """Return what this process has loaded already."""
    return set()
