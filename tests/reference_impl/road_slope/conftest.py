"""A vehicle that brakes to a stop, and runs that are drawn from the model itself."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from floatref_reference.road_slope import priors, rows, springs
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.held import held_by
from floatref_reference.road_slope.middles import middles
from floatref_reference.road_slope.symbols import Places, Readings, Stretch, has_both_sides
from floatref_reference.road_slope.unknowns import (
    Unknowns,
    as_vector,
    by_name,
    known_before,
    start,
)
from floatref_reference.road_slope.wheels import road_points, slopes_under_wheels

AT = Places(front=-0.9, rear=-3.6, lever=1.2)


class Drawn(NamedTuple):
    """A stretch, and the unknowns that it was drawn with."""

    stretch: Stretch
    truth: Unknowns


def braking(c: Constants, K: int, speed: float, cut: int | None) -> Readings:
    """Brake at 2 m/s² to a stop and stand; nothing is read yet."""
    t = np.arange(K) * c.interval_s
    moving = np.minimum(t, speed / 2)
    pause = np.full(K, c.interval_s)
    if cut is not None:
        pause[cut] += 30.0
    zero, along = np.zeros(K), np.where(t < speed / 2, -2.0, 0.0)
    return Readings(zero, zero, speed * moving - moving**2, speed - 2 * moving, along, zero, pause)


@pytest.fixture(scope="session")
def stopping() -> Callable[..., Stretch]:
    """Return what makes a stretch without readings."""

    def make(c: Constants, K: int = 30, speed: float = 4.0, cut: int | None = None) -> Stretch:
        return Stretch(braking(c, K, speed, cut), AT, c)

    return make


def drawn_road(rng: np.random.Generator, N: int, c: Constants) -> tuple[np.ndarray, np.ndarray]:
    """Draw slopes of the precision that the rows of s add up to, and elevations over them."""
    d = c.spacing_m
    change = np.diff(np.eye(N), axis=0)
    precision = change.T @ change / (c.bends * d) + np.eye(N) * d / (c.slope**2 * c.slope_reach_m)
    s = np.linalg.solve(np.linalg.cholesky(precision).T, rng.normal(size=N))
    steps = d * s[:-1] + np.sqrt(c.road * d) * rng.normal(size=N - 1)
    return np.concatenate([[0.0], np.cumsum(steps)]) + c.start_m * rng.normal(), s


def drawn_before_it_moves(stretch: Stretch, rng: np.random.Generator) -> Unknowns:
    """Draw all unknowns but height and pitch of the body."""
    run, c, K = stretch.readings, stretch.constants, len(stretch.readings.place)
    z, s = drawn_road(rng, road_points(stretch).number, c)
    x = by_name(start(stretch), len(z), K)._replace(elevation=z, slope=s)
    held = held_by(as_vector(x), stretch, np.zeros(len(z) - 1))
    moments = [priors.moment_sigma(stretch, held, k) for k in range(K - 1)]

    def walk(first: float, steps: np.ndarray) -> np.ndarray:
        return np.cumsum(np.append(first, steps) * rng.normal(size=K))

    root, fixed = np.sqrt(run.pause[1:]), known_before(c)
    return x._replace(
        bias=walk(c.bias, c.walk * root),
        offset=walk(c.offset_m, c.offset_walk * root),
        moment=walk(c.moment, np.array(moments)),
        heave=(c.heave_m + c.heave_speed * run.speed) * rng.normal(size=K),
        nod=(c.nod_rad + c.nod_speed * run.speed) * rng.normal(size=K),
        **{name: mean + sigma * rng.normal() for name, (mean, sigma) in fixed.items()},
    )


def at_rest(x: Unknowns, stretch: Stretch, k: int) -> tuple[float, float]:
    """Return height and pitch of a body whose springs push as much up as down."""
    at, a, g = stretch.places, stretch.readings.along[k], stretch.constants.gravity
    beta = slopes_under_wheels(x.elevation, stretch)[k]
    over, body = x.gain * (a + g * beta + x.moment[k]), springs.half_car(x, at)
    pitch, L = beta + over, at.front - at.rear
    front = -over * L / (1 + body.front / body.rear)
    still = x._replace(pitch=np.full(len(x.pitch), pitch), height=np.zeros(len(x.pitch)))
    return springs.compressions(still, stretch, at.front)[k] - front, pitch


def drawn_motion(x: Unknowns, stretch: Stretch, rng: np.random.Generator) -> Unknowns:
    """Draw r and θ, of which each row is a line, from rest in two nodes of each piece."""
    K, inside = len(x.pitch), middles(stretch)
    where = by_name(np.arange(len(as_vector(x))), len(x.slope), K)
    unit = np.eye(len(as_vector(x)))[:, [*where.height, *where.pitch]]
    vector = as_vector(x)[:, np.newaxis] + np.column_stack([np.zeros(len(unit)), unit])
    both = by_name(vector, len(x.slope), K)
    made = np.array(springs.bounce_rows(both, stretch) + springs.pitch_rows(both, stretch))
    matrix = [*(made[:, 1:] - made[:, :1])]
    right = [*(rng.normal(size=2 * len(inside)) - made[:, 0])]
    for k in range(K):
        if not has_both_sides(stretch, k - 1):
            height, pitch = at_rest(x, stretch, k)
            matrix += [np.eye(2 * K)[k], np.eye(2 * K)[K + k]]
            right += [height, pitch]
    r, theta = np.split(np.linalg.solve(np.array(matrix), right), 2)
    return x._replace(height=r, pitch=theta)


def force_of(x: Unknowns, stretch: Stretch, rng: np.random.Generator) -> np.ndarray:
    """Read the force that has the noise of its rows, which hold it with the sign of -1."""
    force = np.zeros(len(x.pitch))
    for k, misfit in zip(middles(stretch), rows.acceleration_rows(x, stretch), strict=True):
        force[k] = (misfit - rng.normal()) * rows.acceleration_sigma(stretch, k)
    return force


@pytest.fixture(scope="session")
def drawn() -> Callable[..., Drawn]:
    """Return what draws a run in which every misfit is normal, of mean 0 and 1-σ 1."""

    def draw(stretch: Stretch, seed: int) -> Drawn:
        rng, run = np.random.default_rng(seed), stretch.readings
        x = drawn_motion(drawn_before_it_moves(stretch, rng), stretch, rng)
        off = np.array(rows.height_rows(x, stretch))
        higher = stretch._replace(readings=run._replace(height=run.height + 1))
        unit = np.array(rows.height_rows(x, higher))
        read = (rng.normal(size=len(off)) - off) / (unit - off)
        force = force_of(x, stretch, rng)
        return Drawn(stretch._replace(readings=run._replace(height=read, force=force)), x)

    return draw
