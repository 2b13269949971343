"""Short runs through a stop that are drawn from the equations."""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.plain_equations import (
    Springs,
    as_vector,
    force_read,
    height_read,
    middles,
    spring_sigmas,
)

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.gauss_newton import RANGES, Fit
from floatref.estimators.road_slope.layout import GLOBALS
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.rows import Stretch, Weights
from floatref.values.arrays import FloatArray


class Run(NamedTuple):
    """What is drawn beside the ``seed``.

    Attributes:
        seed: of motion, vehicle, road and noise.
        nodes: K.
        cut: whether a part of the standstill is left out.
        unread: share of heights that are NaN.
        missing: share of nodes where samples of the force are missing.
        lever: whether the laser is away from its accelerometer.
        bend: intensity of the road's slope over the plain road's.
    """

    seed: int
    nodes: int = 20
    cut: bool = False
    unread: float = 0.0
    missing: float = 0.0
    lever: bool = True
    bend: float = 30.0


class Case(NamedTuple):
    """A stretch, and the unknowns that its readings were drawn with."""

    ours: Stretch
    truth: FloatArray


RUNS = st.builds(
    Run,
    seed=st.integers(0, 2**32 - 1),
    nodes=st.integers(12, 17),
    cut=st.booleans(),
    unread=st.sampled_from([0.0, 0.2]),
    missing=st.sampled_from([0.0, 0.2]),
    lever=st.booleans(),
    bend=st.sampled_from([1.0, 30.0, 3000.0]),
)
"""Small: a dense matrix above some hundred rows is shared among processors, which may be busy."""
STEP = 0.06
MODEL = SlopeModel(spacing_m=0.7, segment_m=3.0, start_m=0.02, offset_m=0.02)
"""The level of all is known to 2 cm: the better it is, the more digits a covariance keeps."""


def motion(run: Run, rng: np.random.Generator, interval_s: float) -> Readings:
    """Return place, speed, acceleration and pauses of a brake, a standstill and a start."""
    stop, go = np.sort(rng.choice(np.arange(4, run.nodes - 4), 2, replace=False))
    k, zero = np.arange(run.nodes), np.zeros(run.nodes)
    along = np.where(k < stop, rng.uniform(-4, -1), np.where(k > go, rng.uniform(0.5, 2), 0.0))
    speed = np.cumsum(along) * interval_s
    speed -= speed[stop]
    place = np.cumsum(speed) * interval_s + rng.uniform(0, 500)
    pause = np.full(run.nodes, interval_s)
    if run.cut:
        pause[rng.integers(stop, go + 1)] += rng.uniform(1, 30)
    lost = rng.uniform(size=run.nodes) * (rng.uniform(size=run.nodes) < run.missing)
    noisy = along + 0.1 * rng.normal(size=run.nodes)
    return Readings(1.0 * k, zero, zero, place, np.abs(speed), noisy, lost, pause, interval_s)


def vehicle(run: Run, rng: np.random.Generator) -> Places:
    front, lever = rng.uniform(-2, 1), rng.uniform(-1.5, 1.5)
    return Places(front, front - rng.uniform(2.4, 3.5), lever if run.lever else 0.0)


def unread(run: Run, rng: np.random.Generator, model: SlopeModel) -> Stretch:
    """Return a stretch in which height and force are not yet read."""
    return Stretch(motion(run, rng, float(rng.choice([0.06, 0.1]))), vehicle(run, rng), model)


def constants(rng: np.random.Generator, model: SlopeModel) -> dict[str, float]:
    """Draw the constants of a vehicle, within their ranges."""
    drawn = {name: model.means[name] + model.sigmas[name] * rng.normal() for name in GLOBALS}
    ranges = {name: RANGES.get(name, (-np.inf, np.inf)) for name in GLOBALS}
    return {name: float(np.clip(value, *ranges[name])) for name, value in drawn.items()}


def unknowns(run: Run, rng: np.random.Generator, stretch: Stretch) -> dict[str, Any]:
    """Draw road, vehicle, bias and motion."""
    c, seen, K, N = stretch.model, stretch.readings, run.nodes, stretch.layout.points
    bent = np.sqrt(run.bend * c.bends * c.spacing_m) * rng.normal(size=N)
    s = 0.02 * rng.normal() + np.cumsum(bent)
    steps = c.spacing_m * s[:-1] + np.sqrt(c.road * c.spacing_m) * rng.normal(size=N - 1)
    walks = ("bias", c.bias, c.walk), ("offset", c.offset_m, c.offset_walk)
    x: dict[str, Any] = {"elevation": np.cumsum([c.start_m * rng.normal(), *steps]), "slope": s}
    for name, first, walk in walks:
        sigmas = first, *(walk * np.sqrt(seen.pause_s[1:]))
        x[name] = np.cumsum(sigmas * rng.normal(size=K))
    x["heave"] = (c.heave_m + c.heave_speed * seen.speed) * rng.normal(size=K)
    x["nod"] = (c.nod_rad + c.nod_speed * seen.speed) * rng.normal(size=K)
    x |= constants(rng, c) | {"moment": np.zeros(K)}
    turned = np.diff(Springs(stretch, x).beta)
    steps = np.hypot(c.moment_walk * np.sqrt(seen.pause_s[1:]), c.moment_share * c.gravity * turned)
    x["moment"] = np.cumsum([c.moment * rng.normal(), *(steps * rng.normal(size=K - 1))])
    return in_motion(x, rng, stretch)


def in_motion(x: dict[str, Any], rng: np.random.Generator, stretch: Stretch) -> dict[str, Any]:
    """Return the unknowns with r and θ that follow from the others, and noise.

    The body begins each piece where it would rest.
    """
    seen, springs = stretch.readings, Springs(stretch, x)
    known, K = set(springs.at.tolist()), seen.place.size
    sigma = spring_sigmas(seen, stretch.model, np.arange(K))
    r, theta = np.zeros((2, K))
    for k in range(K):
        r[k], theta[k] = springs.at_rest(k)
        if k - 1 in known:
            r[k], theta[k] = 0.0, 0.0
            at = np.array([k - 1])
            zero, one = springs.values(r, theta, at), np.eye(K)[k]
            higher = springs.values(r + one, theta, at) - zero
            nose_up = springs.values(r, theta + one, at) - zero
            wanted = sigma[:, k - 1] * rng.normal(size=2) - zero[:, 0]
            r[k], theta[k] = np.linalg.solve(np.hstack([higher, nose_up]), wanted)
    return x | {"height": r, "pitch": theta}


def read(run: Run, rng: np.random.Generator, x: dict[str, Any], stretch: Stretch) -> Stretch:
    """Return the stretch with heights and forces; the forces at no row's middle are of no use."""
    K, seen, model = run.nodes, stretch.readings, stretch.model
    height, sigma = height_read(stretch, x)
    height = height + sigma * rng.normal(size=K)
    height[rng.uniform(size=K) < run.unread] = np.nan
    force, at = rng.normal(size=K), middles(seen)
    exact, sigma = force_read(stretch, x)
    force[at] = exact + sigma * rng.normal(size=at.size)
    force *= 1.0 + model.force_share * rng.normal(size=K)
    return Stretch(replace(seen, height=height, force=force), stretch.places, model)


def draw(run: Run, model: SlopeModel = MODEL) -> Case:
    """Return a run in which every misfit of a reading has the 1-σ of 1."""
    rng = np.random.default_rng(run.seed)
    stretch = unread(run, rng, model)
    x = unknowns(run, rng, stretch)
    return Case(read(run, rng, x, stretch), as_vector(stretch, x))


def over_hump(seed: int, nodes: int = 60) -> Case:
    """Return a brake with a hump of 12 cm under the stop, with the usual constants."""
    model, run = SlopeModel(spacing_m=0.5), Run(seed, nodes=nodes)
    rng = np.random.default_rng(seed)
    stretch = unread(run, rng, model)
    x = unknowns(run, rng, stretch)
    places = stretch.first_m + 0.5 * np.arange(stretch.layout.points)
    hump = 0.12 * np.exp(-(((places - stretch.readings.place.max() + 1.5) / 2.5) ** 2))
    x = in_motion(x | {"elevation": hump, "slope": np.gradient(hump, 0.5)}, rng, stretch)
    return Case(read(run, rng, x, stretch), as_vector(stretch, x))


def groups(stretch: Stretch) -> dict[str, slice]:
    """Return which rows are of what; the fixed ones are before these."""
    heights = int(np.sum(~np.isnan(stretch.readings.height)))
    K, M = stretch.layout.nodes, middles(stretch.readings).size
    sizes = {"height": heights, "offset": K - 1, "moment": K - 1}
    sizes |= {"acceleration": M, "bounce": M, "pitch": M}
    found, begin = {}, stretch.fixed_sigma.size
    for name, size in sizes.items():
        found[name], begin = slice(begin, begin + size), begin + size
    return found


def held(case: Case) -> Weights:
    """Return what a pass holds that begins at the truth."""
    return case.ours.weights(case.truth, np.full(case.ours.layout.points - 1, 1e-5))


def at_speed(
    speed: FloatArray, along: float | FloatArray = 0.0, lever: float = 0.0, **changed: Any
) -> Stretch:
    """Return nodes at these speeds, with heights and forces of 0 unless they are ``changed``."""
    zero, full = np.zeros(speed.size), np.ones(speed.size)
    place = np.cumsum(speed) * STEP
    usual = {"height": zero, "force": zero, "place": place} | changed
    seen = Readings(
        bins=np.arange(1.0 * speed.size),
        speed=speed,
        along=along * full,
        missing=zero,
        pause_s=STEP * full,
        interval_s=STEP,
        **usual,
    )
    return Stretch(seen, Places(-0.8, -3.5, lever), SlopeModel())


def as_if(stretch: Stretch, y: FloatArray, bend: float = 1e-5) -> Fit:
    """Return a fit that has found the unknowns ``y``."""
    return Fit(stretch, y, np.full(stretch.layout.points - 1, bend), 7, 0.0)


def drawn_fit(run: Run) -> Fit:
    case = draw(run)
    return Fit(case.ours, case.truth, held(case).bends, 7, 0.0)


def marks_of(stretch: Stretch, *shares: float) -> FloatArray:
    """Return points of the road at these shares of it."""
    last = stretch.layout.points - 1
    return stretch.first_m + stretch.model.spacing_m * np.rint(last * np.array(shares))


def braked(nodes: int = 60, first: int = 30, last: int = 38) -> Stretch:
    """Return a run at 12 m/s that brakes by 3 m/s² from node to node."""
    k = np.arange(nodes)
    along = -3.0 * ((k >= first) & (k <= last))
    stretch = at_speed(12.0 + STEP * np.cumsum(along), along)
    return Stretch(stretch.readings, stretch.places, replace(stretch.model, spacing_m=1.0))


def replaced(stretch: Stretch, spacing_m: float) -> Stretch:
    """Return the stretch with points of the road so far apart."""
    model = replace(stretch.model, spacing_m=spacing_m)
    return Stretch(stretch.readings, stretch.places, model)
