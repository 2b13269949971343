"""An estimate of the road under a model's tyres and of the model's states."""

from dataclasses import dataclass

from floatref.values.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Estimate:
    """Road and states at N samples, for p tyres and n freedoms; NaN where it is unknown.

    Attributes:
        road: height under each tyre, shape (N, p), in m.
        road_sigma: its standard deviation, shape (N, p), in m.
        states: x = (q, q'), shape (N, 2n), in m, rad, m/s and rad/s.
        states_sigma: their standard deviations, shape (N, 2n), in the same units.
        force: F of each tyre, shape (N, p), in N; None from an estimator that has no forces.
        force_sigma: its standard deviation, shape (N, p), in N; None likewise.
    """

    road: FloatArray
    road_sigma: FloatArray
    states: FloatArray
    states_sigma: FloatArray
    force: FloatArray | None = None
    force_sigma: FloatArray | None = None
