"""Short drives over drawn roads, in closed form: cheap enough for a thousand files."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, Recording, Setup, UniformClock

G = 9.80665
STANDOFF_M = 0.3
RATES_HZ = (500, 1000, 2000)
SPEEDS_MPS = (8.0, 28.0)
SECONDS = (3.0, 20.0)
FIXES_HZ = 5
EARTH_M = 6_371_000.0
DISTRICT = ((0.85, 0.14), (0.8505, 0.1408))
"""South-western and north-eastern corner, latitude and longitude in rad."""
BUMPS = 80
WAVELENGTHS_M = (0.5, 60.0)
ROUGHNESS = (4e-6, 64e-6)
"""Displacement spectral density at 0.1 cycles/m in m3, from a good road to a poor one."""

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Sines:
    """A sum of sines of drawn phases: amplitudes, angular frequencies, phases."""

    amplitudes: Floats
    frequencies: Floats
    phases: Floats

    def at(self, where: Floats, derivative: int = 0) -> Floats:
        total = np.zeros_like(where)
        turned = self.phases + derivative * np.pi / 2
        for a, w, p in zip(self.amplitudes, self.frequencies, turned, strict=True):
            total += a * w**derivative * np.sin(w * where + p)
        return total


def road(draw: np.random.Generator) -> Sines:
    """Return an elevation in m over distance in m, of density falling with wave number squared."""
    edges = 1 / np.geomspace(*WAVELENGTHS_M, BUMPS + 1)
    numbers = np.sqrt(edges[1:] * edges[:-1])
    roughness = np.exp(draw.uniform(*np.log(ROUGHNESS)))
    density = roughness * (numbers / 0.1) ** -2
    phases = draw.uniform(0, 2 * np.pi, BUMPS)
    return Sines(np.sqrt(2 * density * -np.diff(edges)), 2 * np.pi * numbers, phases)


def bounce(draw: np.random.Generator) -> Sines:
    """Return how the body moves up and down, in m over s."""
    hz = draw.uniform((0.9, 1.3, 1.8), (1.2, 1.7, 2.5))
    return Sines(draw.uniform(0.002, 0.006, 3), 2 * np.pi * hz, draw.uniform(0, 6, 3))


def drive(
    draw: np.random.Generator,
    seconds: float | None = None,
    rate_hz: int | None = None,
    tracks: tuple[str, ...] | None = None,
    placed: bool = True,
) -> Recording:
    """Return a drive at a drawn speed that swells by a twentieth, with fixes if ``placed``."""
    clock = UniformClock.of(rate_hz or int(draw.choice(RATES_HZ)))
    drawn = draw.uniform(*SECONDS) if seconds is None else seconds
    times = clock.times(round(drawn * clock.rate))
    speed, swell = draw.uniform(*SPEEDS_MPS), draw.uniform(0.3, 0.6)
    distance = speed * (times + 0.05 * (1 - np.cos(swell * times)) / swell)
    channels = [Channel.of("distance", distance, clock)]
    for track in tracks or (("left", "right") if draw.random() < 0.5 else ("main",)):
        under, body = road(draw), bounce(draw)
        noise = draw.normal(0, 1e-3, times.size)
        height = STANDOFF_M + body.at(times) - under.at(distance)
        force = G + body.at(times, 2) + noise
        channels.append(Channel.of("vertical_specific_force", force, clock, track))
        channels.append(Channel.of("height", height, clock, track))
    if placed:
        channels += fixes(draw, times, distance)
    return Recording(tuple(channels), Setup(profile_interval_m=0.05))


def fixes(draw: np.random.Generator, times: Floats, distance: Floats) -> list[Channel]:
    """Return latitude and longitude in rad along a straight road of drawn place and heading."""
    clock = UniformClock.of(FIXES_HZ)
    count = int(times[-1] * FIXES_HZ) + 1
    gone = np.interp(clock.times(count), times, distance)
    place, heading = draw.uniform(*DISTRICT), draw.uniform(0, 2 * np.pi)
    north, east = np.cos(heading) / EARTH_M, np.sin(heading) / EARTH_M / np.cos(place[0])
    return [
        Channel.of("gnss_latitude", place[0] + gone * north, clock),
        Channel.of("gnss_longitude", place[1] + gone * east, clock),
    ]
