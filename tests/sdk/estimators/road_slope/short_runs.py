"""Short runs through a stop that are drawn from the equations, for SDK and reference at once."""

from typing import NamedTuple

import numpy as np
from hypothesis import strategies as st

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.rows import Stretch
from floatref.values.arrays import FloatArray
from floatref_reference.road_slope import rows, symbols
from floatref_reference.road_slope.swing import swing
from floatref_reference.road_slope.unknowns import Unknowns, by_name, kept_in_range
from floatref_reference.road_slope.wheels import road_points


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
    """The same readings for both programs, and the unknowns that they were drawn with."""

    ours: Stretch
    literal: symbols.Stretch
    truth: Unknowns


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
MODEL = SlopeModel(spacing_m=0.7, segment_m=3.0, start_m=0.02, offset_m=0.02)
"""The level of all is known to 2 cm: the better it is, the more digits a covariance keeps."""


def literally(model: SlopeModel, interval_s: float) -> symbols.Constants:
    """Return the constants as the reference names them, with nodes ``interval_s`` apart."""
    return symbols.Constants(
        interval=interval_s,
        spacing=model.spacing_m,
        g=model.gravity,
        read=model.reading_m,
        road=model.road,
        bend=model.bends,
        bend_weight=model.bend_weight,
        most_bend=model.most_bend,
        first_bend=model.first_bend,
        segment=model.segment_m,
        acceleration=model.acceleration,
        force_share=model.force_share,
        missing_acceleration=model.missing_acceleration,
        bias=model.bias,
        walk=model.walk,
        swing=model.swing,
        swing_speed=model.swing_speed,
        even=model.even_m,
        even_speed=model.even_speed,
        slope=model.slope,
        slope_reach=model.slope_reach_m,
        gain=symbols.Prior(model.gain, model.gain_sigma),
        lean=symbols.Prior(model.lean_rad, model.lean_sigma_rad),
        centre=symbols.Prior(model.centre, model.centre_sigma),
        offset=model.offset_m,
        hz=symbols.Prior(model.hz, model.hz_sigma),
        damping=symbols.Prior(model.damping, model.damping_sigma),
        start_height=model.start_m,
    )


def motion(run: Run, rng: np.random.Generator, interval_s: float) -> tuple[FloatArray, ...]:
    """Return place, speed, acceleration and pauses of a brake, a standstill and a start."""
    stop, go = np.sort(rng.choice(np.arange(4, run.nodes - 3), 2, replace=False))
    k = np.arange(run.nodes)
    along = np.where(k < stop, rng.uniform(-4, -1), np.where(k > go, rng.uniform(0.5, 2), 0.0))
    speed = np.cumsum(along) * interval_s
    speed -= speed[stop]
    place = np.cumsum(speed) * interval_s + rng.uniform(0, 500)
    pause = np.full(run.nodes, interval_s)
    if run.cut:
        pause[rng.integers(stop, go + 1)] += rng.uniform(1, 30)
    return place, np.abs(speed), along + 0.1 * rng.normal(size=run.nodes), pause


def vehicle(run: Run, rng: np.random.Generator) -> symbols.Places:
    front, lever = rng.uniform(-2, 1), rng.uniform(-1.5, 1.5)
    return symbols.Places(front, front - rng.uniform(2.4, 3.5), lever if run.lever else 0.0)


def unread(run: Run, rng: np.random.Generator, model: SlopeModel) -> symbols.Stretch:
    """Return a stretch in which height and force are not yet read."""
    interval_s = float(rng.choice([0.06, 0.1]))
    place, speed, along, pause = motion(run, rng, interval_s)
    zero = np.zeros(run.nodes)
    lost = rng.uniform(size=run.nodes) * (rng.uniform(size=run.nodes) < run.missing)
    readings = symbols.Readings(zero, zero, place, speed, along, lost, pause)
    return symbols.Stretch(readings, vehicle(run, rng), literally(model, interval_s))


def drawn_constants(rng: np.random.Generator, c: symbols.Constants) -> list[float]:
    """Return κ, λ, H, h_0, ln f and ln ζ."""
    linear = [p.mean + p.sigma * rng.normal() for p in (c.gain, c.lean, c.centre)]
    logs = [np.log(p.mean) + p.sigma * rng.normal() for p in (c.hz, c.damping)]
    return [*linear, c.offset * rng.normal(), *logs]


def true_unknowns(run: Run, rng: np.random.Generator, stretch: symbols.Stretch) -> Unknowns:
    """Draw road, bias, constants and motion."""
    c, K, N = stretch.constants, run.nodes, road_points(stretch).number
    bent = np.sqrt(run.bend * c.bend * c.spacing) * rng.normal(size=N)
    s = 0.02 * rng.normal() + np.cumsum(bent)
    steps = c.spacing * s[:-1] + np.sqrt(c.road * c.spacing) * rng.normal(size=N - 1)
    z = np.cumsum([c.start_height * rng.normal(), *steps])
    walked = c.walk * np.sqrt(stretch.readings.pause[1:]) * rng.normal(size=K - 1)
    b = np.cumsum([c.bias * rng.normal(), *walked])
    vector = np.concatenate([z, s, np.zeros(2 * K), b, drawn_constants(rng, c)])
    return in_motion(kept_in_range(by_name(vector, N, K)), rng, stretch)


def in_motion(x: Unknowns, rng: np.random.Generator, stretch: symbols.Stretch) -> Unknowns:
    """Return the unknowns with θ and r that follow from the others, and their noise."""
    one = np.ones(len(x.height))
    x = x._replace(pitch=swung(x, stretch, rng), height=0 * one)
    low, high = (np.array(rows.even_rows(y, stretch)) for y in (x, x._replace(height=one)))
    return x._replace(height=(rng.normal(size=one.size) - low) / (high - low))


def swung(x: Unknowns, stretch: symbols.Stretch, rng: np.random.Generator) -> FloatArray:
    """Return θ of a body that begins each piece where it would rest."""
    run, c, K = stretch.readings, stretch.constants, len(x.pitch)
    slopes, theta = rows.slopes_under_wheels(x, stretch), np.zeros(K)
    u = [rows.rolled_over(x, slopes, stretch, k) for k in range(K)]
    by = swing(np.exp(x.log_hz), np.exp(x.log_damping), c.interval)
    for k in range(K):
        theta[k] = u[k]
        if symbols.has_both_sides(stretch, k - 1):
            driven = by.before * u[k - 2] + by.now * u[k - 1] + by.after * u[k]
            sigma = (c.swing + c.swing_speed * run.speed[k - 1]) * c.interval**1.5
            theta[k] = by.trace * theta[k - 1] - by.determinant * theta[k - 2] + driven
            theta[k] += sigma * rng.normal()
    return theta


def read(
    run: Run, rng: np.random.Generator, x: Unknowns, stretch: symbols.Stretch
) -> symbols.Stretch:
    """Return the stretch with heights and forces; the forces at no row's middle are of no use."""
    K, seen = run.nodes, stretch.readings
    off = np.array(rows.height_rows(x, stretch))
    higher = stretch._replace(readings=seen._replace(height=np.ones(K)))
    height = (rng.normal(size=K) - off) / (np.array(rows.height_rows(x, higher)) - off)
    height[rng.uniform(size=K) < run.unread] = np.nan
    force = rng.normal(size=K)
    inside = [k for k in range(K) if symbols.has_both_sides(stretch, k)]
    for k, misfit in zip(inside, rows.acceleration_rows(x, stretch), strict=True):
        force[k] = (misfit - rng.normal()) * rows.acceleration_sigma(stretch, k)
    unsure = 1.0 + stretch.constants.force_share * rng.normal(size=K)
    return stretch._replace(readings=seen._replace(height=height, force=force * unsure))


def as_ours(literal: symbols.Stretch, model: SlopeModel) -> Stretch:
    """Return a stretch of the reference as one of the SDK."""
    seen = literal.readings
    readings = Readings(
        np.arange(len(seen.place), dtype=np.float64), *seen, literal.constants.interval
    )
    return Stretch(readings, Places(*literal.places), model)


def draw(run: Run, model: SlopeModel = MODEL) -> Case:
    """Return a run in which every misfit of a reading has the 1-σ of 1."""
    rng = np.random.default_rng(run.seed)
    stretch = unread(run, rng, model)
    truth = true_unknowns(run, rng, stretch)
    literal = read(run, rng, truth, stretch)
    return Case(as_ours(literal, model), literal, truth)
