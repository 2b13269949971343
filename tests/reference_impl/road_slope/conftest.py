"""A vehicle that brakes to a stop, and runs that are drawn from the model itself."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from floatref_reference.road_slope import rows
from floatref_reference.road_slope.swing import swing
from floatref_reference.road_slope.symbols import Constants, Places, Prior, Readings, Stretch
from floatref_reference.road_slope.unknowns import Unknowns, by_name
from floatref_reference.road_slope.wheels import road_points

AT = Places(front=-0.9, rear=-3.6, lever=1.2)


class Drawn(NamedTuple):
    """A stretch, and the unknowns that it was drawn with."""

    stretch: Stretch
    truth: Unknowns


def braking(c: Constants, K: int, speed: float, cut: int | None) -> Readings:
    """Brake at 2 m/s² to a stop and stand; nothing is read yet."""
    t = np.arange(K) * c.interval
    moving = np.minimum(t, speed / 2)
    pause = np.full(K, c.interval)
    if cut is not None:
        pause[cut] += 30.0
    zero, along = np.zeros(K), np.where(t < speed / 2, -2.0, 0.0)
    return Readings(zero, zero, speed * moving - moving**2, speed - 2 * moving, along, zero, pause)


@pytest.fixture(scope="session")
def stopping() -> Callable[..., Stretch]:
    """Return what makes a stretch without readings."""

    def make(c: Constants, K: int = 40, speed: float = 5.0, cut: int | None = None) -> Stretch:
        return Stretch(braking(c, K, speed, cut), AT, c)

    return make


def drawn_road(rng: np.random.Generator, N: int, c: Constants) -> tuple[np.ndarray, np.ndarray]:
    """Draw slopes of the precision that the rows of s add up to, and elevations over them."""
    d = c.spacing
    change = np.diff(np.eye(N), axis=0)
    precision = change.T @ change / (c.bend * d) + np.eye(N) * d / (c.slope**2 * c.slope_reach)
    s = np.linalg.solve(np.linalg.cholesky(precision).T, rng.normal(size=N))
    steps = d * s[:-1] + np.sqrt(c.road * d) * rng.normal(size=N - 1)
    return np.concatenate([[0.0], np.cumsum(steps)]) + c.start_height * rng.normal(), s


def drawn_constants(rng: np.random.Generator, c: Constants) -> list[float]:
    def of(prior: Prior) -> float:
        return prior.mean + prior.sigma * rng.normal()

    log_hz = np.log(c.hz.mean) + c.hz.sigma * rng.normal()
    log_damping = np.log(c.damping.mean) + c.damping.sigma * rng.normal()
    offset = c.offset * rng.normal()
    return [of(c.gain), of(c.lean), of(c.centre), offset, log_hz, log_damping]


def force_of(x: Unknowns, stretch: Stretch, rng: np.random.Generator) -> np.ndarray:
    """Read the force that has the noise of its rows, which hold it with the sign of -1."""
    inside = [k for k in range(len(x.pitch)) if rows.has_both_sides(stretch, k)]
    force = np.zeros(len(x.pitch))
    for k, misfit in zip(inside, rows.acceleration_rows(x, stretch), strict=True):
        force[k] = (misfit - rng.normal()) * rows.acceleration_sigma(stretch, k)
    return force


def drawn_motion(
    x: Unknowns, stretch: Stretch, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Draw θ from rest, piece by piece, and r, of which each row is a line."""
    run, c, K = stretch.readings, stretch.constants, len(x.pitch)
    slopes = rows.slopes_under_wheels(x, stretch)
    u = [rows.rolled_over(x, slopes, stretch, k) for k in range(K)]
    by = swing(np.exp(x.log_hz), np.exp(x.log_damping), c.interval)
    for k in range(K):
        x.pitch[k] = u[k]
        if rows.has_both_sides(stretch, k - 1):
            driven = by.before * u[k - 2] + by.now * u[k - 1] + by.after * u[k]
            free = by.trace * x.pitch[k - 1] - by.determinant * x.pitch[k - 2]
            sigma = (c.swing + c.swing_speed * run.speed[k - 1]) * c.interval**1.5
            x.pitch[k] = free + driven + sigma * rng.normal()
    resting = np.array(rows.even_rows(x._replace(height=np.zeros(K)), stretch))
    per_m = np.array(rows.even_rows(x._replace(height=np.ones(K)), stretch)) - resting
    return x.pitch, (rng.normal(size=K) - resting) / per_m


@pytest.fixture(scope="session")
def drawn() -> Callable[..., Drawn]:
    """Return what draws a run in which every misfit is normal, of mean 0 and 1-σ 1."""

    def draw(stretch: Stretch, seed: int) -> Drawn:
        rng, c, run = np.random.default_rng(seed), stretch.constants, stretch.readings
        N, K = road_points(stretch).number, len(run.place)
        z, s = drawn_road(rng, N, c)
        b = np.cumsum(c.walk * np.sqrt(run.pause) * rng.normal(size=K))
        b += c.bias * rng.normal() - b[0]
        vector = np.concatenate([z, s, np.zeros(2 * K), b, drawn_constants(rng, c)])
        x = by_name(vector, N, K)
        pitch, height = drawn_motion(x, stretch, rng)
        x = x._replace(pitch=pitch, height=height)
        off = np.array(rows.height_rows(x, stretch))
        higher = stretch._replace(readings=run._replace(height=run.height + 1))
        unit = np.array(rows.height_rows(x, higher))
        read = (rng.normal(size=K) - off) / (unit - off)
        force = force_of(x, stretch, rng)
        return Drawn(stretch._replace(readings=run._replace(height=read, force=force)), x)

    return draw
