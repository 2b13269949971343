"""Tyres with damping: the road under each as a state, u' = (F - k·u)/c, beside the model's own."""

from math import expm1

import numpy as np

from floatref.response.model import Tyre, VehicleModel
from floatref.response.state_space import Discrete


def with_tyre_states(model: VehicleModel, discrete: Discrete) -> Discrete:
    """Return ``discrete`` with a state u, in m, for each tyre of ``model`` that has damping.

    They come behind x, in the order of the tyres. Each is exact for forces that change linearly
    between samples, whatever the forces of ``discrete`` do: were they to stay, u would lag.
    """
    damped = [(at, tyre) for at, tyre in enumerate(model.tyres) if tyre.damping > 0]
    size, inputs = discrete.before.shape
    total = size + len(damped)
    transition = np.zeros((total, total))
    transition[:size, :size] = discrete.transition
    before, after = np.zeros((total, inputs)), np.zeros((total, inputs))
    before[:size], after[:size] = discrete.before, discrete.after
    for row, (column, tyre) in enumerate(damped, size):
        stays, before[row, column], after[row, column] = _decay(tyre, discrete.step_s)
        transition[row, row] = stays
    return Discrete(transition, before, after, discrete.step_s)


def _decay(tyre: Tyre, step_s: float) -> tuple[float, float, float]:
    """Return what u keeps over a step, and what 1 N before it and 1 N after it give."""
    steps = tyre.stiffness * step_s / tyre.damping
    lost = -expm1(-steps)
    # 1 - lost/steps, by its series where the difference would be rounding.
    ramp = steps / 2 - steps**2 / 6 + steps**3 / 24 if steps < 1e-4 else 1.0 - lost / steps
    return 1.0 - lost, (lost - ramp) / tyre.stiffness, ramp / tyre.stiffness
