"""What the joint input-state filter takes, stores and estimates; nothing compiled.

See `floatref.estimators.models.kalman_values` on caches of compiled kernels.
"""

from typing import NamedTuple

from floatref.values.arrays import FloatArray


class System(NamedTuple):
    """(12) and (13) of Zhu for states less `after` times inputs: s states, p inputs, m readings."""

    transition: FloatArray
    """A_c, (s, s)."""
    influence: FloatArray
    """B_c, (s, p)."""
    output: FloatArray
    """G, (m, s)."""
    direct: FloatArray
    """J, (m, p)."""
    feedthrough: FloatArray
    """J + G·after, (m, p): takes the place of J in steps (a) and (b)."""
    variance: FloatArray
    """The diagonal of R, (m,)."""
    disturbance: FloatArray
    """Q, (s, s)."""
    after: FloatArray
    """Influence of the inputs on states at the same time, (s, p)."""
    unknown: FloatArray
    """Variance about their last value of inputs that no reading shows, (p,)."""
    stays: float
    """Share of their error that is the same one sample later."""


class Memory(NamedTuple):
    """What goes from sample to sample, written in place."""

    state: FloatArray
    """X, (s,)."""
    covariance: FloatArray
    """P, (s, s)."""
    force: FloatArray
    """F, (p,)."""
    spread: FloatArray
    """P_F, (p, p)."""
    crossed: FloatArray
    """P_XF, (s, p)."""


class Estimates(NamedTuple):
    """Inputs (N, p) and states (N, s) of N samples, with their variances."""

    forces: FloatArray
    force_variance: FloatArray
    states: FloatArray
    states_variance: FloatArray
