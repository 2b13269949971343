"""The model of the road prior in two peers of `bench_road_prior.py`, at every sample.

One is the literal smoother of `floatref_reference`, the other filterpy, which is given the
matrices of each step. Both read the height sensor at the nodes of the stage and nowhere else.
"""

from dataclasses import dataclass

import numpy as np
from kalman_peers import smoothed_linear
from kalman_task import TRACK

from floatref.estimators.road_prior import RoadPrior
from floatref.estimators.road_prior.excitation import Excitation
from floatref.estimators.road_prior.track import sub_block
from floatref.stages.signals import ACCELERATION, DISTANCE, HEIGHT
from floatref.values.arrays import FloatArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId
from floatref_reference.road_prior import model
from floatref_reference.road_prior.smoother import smooth
from floatref_reference.road_prior.symbols import Constants, Recorded, recorded


def signals(header: Header, block: Block, prior: RoadPrior) -> Recorded:
    """Return what ``block``, the first of its stream, tells the literal smoother.

    Between nodes the inputs are linear, as they are to the stage.
    """
    distance, a = block[ChannelId(DISTANCE)], block[ChannelId(ACCELERATION, TRACK)]
    height, every = block[ChannelId(HEIGHT, TRACK)], sub_block(header.step)
    nodes = np.arange(0, a.size, every)
    excitation = Excitation.of(every * header.step, prior.pitch_hz, prior.pitch_damping)
    excitation.add(distance[nodes])
    excitation.end()
    a_x, response = excitation.take()
    samples = np.arange(a.size)
    inputs = [np.interp(samples, nodes, u) for u in (a_x, a_x * response)]
    seen = np.full(a.size, np.nan)
    seen[nodes] = height[nodes] - height[0]
    # A road moves between nodes by what it has moved there: held, where distance is not known.
    return recorded(
        samples * header.step,
        np.maximum.accumulate(np.interp(samples, nodes, distance[nodes])),
        a,
        seen,
        np.stack(inputs, axis=-1),
        inputs[0],
    )


def constants(prior: RoadPrior) -> Constants:
    return Constants(
        prior.acceleration,
        prior.acceleration_walk,
        prior.walk_along,
        prior.reading_m,
        prior.road,
        prior.long_waves,
        prior.road_reach_m,
        sigma_b=prior.acceleration_bias,
        sigma_kappa=(prior.lean_sigma_rad, prior.tilt_sigma),
    )


def by_reference(run: Recorded, c: Constants) -> FloatArray:
    """Return the smoothed height by the literal smoother."""
    return smooth(run, c).r[0]


@dataclass(frozen=True, eq=False)
class Steps:
    """Matrices and known inputs of all steps, made before any clock starts."""

    run: Recorded
    c: Constants
    f: FloatArray
    q: FloatArray
    g: FloatArray

    @classmethod
    def of(cls, run: Recorded, c: Constants) -> "Steps":
        steps = range(run.t.size - 1)
        f = np.array([model.transition(run, k, c) for k in steps])
        q = np.array([model.process_noise(run, k, c) for k in steps])
        return cls(run, c, f, q, np.array([model.known_input(run, k) for k in steps]))


def by_filterpy(steps: Steps) -> FloatArray:
    """Return the smoothed height by `KalmanFilter` and `rts_smoother`."""
    from filterpy.kalman import KalmanFilter, rts_smoother

    run, n, states = steps.run, steps.run.t.size, steps.f.shape[1]
    kalman = KalmanFilter(states, 1)
    kalman.x, kalman.P = np.zeros(states), model.prior(run, steps.c)
    kalman.H = model.observation(run)
    unit, noise = np.eye(states), np.array([[steps.c.sigma_h**2]])
    xs, ahead, ps = np.empty((n, states)), np.empty((n, states)), np.empty((n, states, states))
    for k in range(n):
        if k > 0:
            kalman.predict(steps.g[k - 1], unit, steps.f[k - 1], steps.q[k - 1])
        ahead[k] = kalman.x
        if not np.isnan(run.h[0, k]):
            kalman.update(run.h[:, k], noise)
        xs[k], ps[k] = kalman.x, kalman.P
    # The smoother asks for the step behind the last sample as well.
    f, q = np.append(steps.f, unit[None], axis=0), np.append(steps.q, 0.0 * unit[None], axis=0)
    return smoothed_linear(rts_smoother, xs, ps, f, q, ahead)
