"""The observer with unknown inputs (8)-(15) of Imine, sampled: the road under every tyre."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, isfinite

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.estimators.estimate import Estimate
from floatref.vehicle_response.estimators.gains import (
    TIME_CONSTANTS,
    decay_rate,
    gain_matrix,
    output_matrix,
)
from floatref.vehicle_response.estimators.unknown_inputs import (
    ObserverEquations,
    ObserverMemory,
    damped_tyres,
    observe,
    observer_equations,
    wheel_equations,
)
from floatref.vehicle_response.models.model import VehicleModel
from floatref.vehicle_response.models.outputs import Reading
from floatref.vehicle_response.models.state_space import Sampled, sample, stationary_sigma

DEGREES = 1, 2, 3
"""Degree of the polynomial between two samples. At 10 Hz and 128 samples a second, lines lose
two hundredths of an acceleration, and cubics two thousandths."""


@dataclass(frozen=True, eq=False)
class UnknownInputObserver:
    """The observer of one model, its gains and its sensors; made by `of`.

    Road and standard deviations are NaN, and the states not valid, until `settling_s` has passed
    since the start and since the last absent value.

    Attributes:
        model: n freedoms on p tyres.
        measured: displacements y, k of them.
        step_s: between two samples.
        settling_s: ten time constants of the slowest eigenvalue of (14).
        error_matrix: L of (14); the road under a tyre with damping is a state of it.
    """

    model: VehicleModel
    measured: tuple[Reading, ...]
    step_s: float
    settling_s: float
    error_matrix: FloatArray
    _steps: tuple[FloatArray, FloatArray]
    _start: FloatArray
    _road: tuple[FloatArray, FloatArray]
    _sigma: tuple[FloatArray, FloatArray]

    @classmethod
    def of(
        cls,
        model: VehicleModel,
        step_s: float,
        gains: ArrayLike,
        measured: Sequence[Reading],
        acceleration_sigma: float,
        degree: int = 3,
    ) -> "UnknownInputObserver":
        """Return the observer with ``gains`` as in `gain_matrix` and displacements ``measured``.

        ``acceleration_sigma`` is that of one sample of a wheel's acceleration, in m/s². Between
        two samples the inputs are the polynomial of ``degree`` through the newest. Raises
        InputError for gains or readings that do not let the error decay, see `decay_rate`, for
        wrong shapes, for values that are not finite, and for models as in `observer_equations`.
        """
        _check_positive(model, "step_s", step_s)
        _check_positive(model, "acceleration_sigma", acceleration_sigma)
        if degree not in DEGREES:
            raise InputError(f"model {model.name}: degree is {degree}; give one of 1, 2, 3")
        outputs = output_matrix(model, measured)
        gain = gain_matrix(model, measured, gains)
        closed = observer_equations(model, gain, outputs)
        free = observer_equations(model, np.zeros_like(gain), outputs)
        rate = decay_rate(model, measured, outputs, closed.error)
        steps = [sample(each.error, each.inputs, step_s, degree) for each in (closed, free)]
        noise = np.array([r.sigma for r in measured] + [acceleration_sigma] * len(model.tyres))
        return cls(
            model=model,
            measured=tuple(measured),
            step_s=step_s,
            settling_s=TIME_CONSTANTS / rate,
            error_matrix=closed.error,
            _steps=(np.stack([s.transition for s in steps]), np.stack([s.taps for s in steps])),
            _start=_start(model, outputs),
            _road=(closed.road_of_state, closed.road_of_input),
            _sigma=_sigmas(closed, steps[0], noise, 2 * len(model.freedoms)),
        )

    def begin(self) -> ObserverMemory:
        """Return the memory of a stream that has not begun."""
        return ObserverMemory.of(self._steps[1])

    def estimate(self, displacements: FloatArray, wheel_accelerations: FloatArray) -> Estimate:
        """Return road and states of N samples: y, shape (N, k), and z'', shape (N, p), in m/s².

        Accelerations are those of the wheels in the order of the model's tyres, without gravity.
        NaN marks a missing value. Raises InputError for other shapes.
        """
        return self.advance(self.begin(), displacements, wheel_accelerations)

    def advance(
        self, memory: ObserverMemory, displacements: FloatArray, wheel_accelerations: FloatArray
    ) -> Estimate:
        """Return what `estimate` does for the next samples of a stream; changes ``memory``."""
        inputs = self._inputs(displacements, wheel_accelerations)
        n, p = len(self.model.freedoms), len(self.model.tyres)
        states = np.empty((inputs.shape[0], self._steps[0].shape[1]))
        road, settled = np.empty((inputs.shape[0], p)), np.empty(inputs.shape[0], dtype=np.bool_)
        settling = ceil(self.settling_s / self.step_s)
        observe(
            *self._steps, self._start, *self._road, settling, inputs, memory, states, road, settled
        )
        known = settled[:, None]
        return Estimate(
            road=np.where(known, road, np.nan),
            road_sigma=np.where(known, self._sigma[1], np.nan),
            states=states[:, : 2 * n],
            states_sigma=np.where(known, self._sigma[0], np.nan),
        )

    def _inputs(self, displacements: FloatArray, wheel_accelerations: FloatArray) -> FloatArray:
        y = np.asarray(displacements, dtype=np.float64)
        z = np.asarray(wheel_accelerations, dtype=np.float64)
        count = y.shape[0] if y.ndim else 0
        self._check_inputs("displacements", y, (count, len(self.measured)))
        self._check_inputs("wheel_accelerations", z, (count, len(self.model.tyres)))
        return np.hstack([y, z])

    def _check_inputs(self, name: str, values: FloatArray, shape: tuple[int, int]) -> None:
        if values.shape != shape:
            raise InputError(
                f"model {self.model.name}: {name} have the shape {values.shape}; the observer "
                f"needs {shape}"
            )
        if np.isinf(values).any():
            raise InputError(
                f"model {self.model.name}: {name} hold an infinite value; give NaN where nothing "
                "was measured"
            )


def _start(model: VehicleModel, outputs: FloatArray) -> FloatArray:
    """Return the state of a first sample: displacements as measured, at rest."""
    damped = damped_tyres(model)
    stiffness = np.array([tyre.stiffness for tyre in model.tyres])
    still = np.hstack([np.linalg.pinv(outputs), np.zeros((outputs.shape[1], stiffness.size))])
    road = wheel_equations(model)[0] @ still / stiffness[:, None]
    return np.vstack([still, road[damped]])


def _sigmas(
    equations: ObserverEquations, system: Sampled, noise: FloatArray, states: int
) -> tuple[FloatArray, FloatArray]:
    """Return those of the states, shape (2n,), and of the road, shape (p,)."""
    size, width = equations.inputs.shape
    of_state = stationary_sigma(system, noise, np.eye(size)[:states], np.zeros((states, width)))
    return of_state, stationary_sigma(
        system, noise, equations.road_of_state, equations.road_of_input
    )


def _check_positive(model: VehicleModel, name: str, value: float) -> None:
    if not (isfinite(value) and value > 0):
        raise InputError(f"model {model.name}: {name} is {value:g}; give a number above zero")
