"""The joint input-state filter of Gillijns and De Moor, steps (a)-(c) of Zhu, for any model.

Forces of the tyres and all states come from whichever accelerations, velocities and displacements
are measured. A tyre with damping turns its force into the road by a state of its own, so that the
road's standard deviation is that of the filter, too. That state has no process noise: forces of
such tyres above half the sampling rate have to be filtered from the readings before they are
sampled, else the road errs by far more than its standard deviation.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, expm1

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.estimators.estimate import Estimate
from floatref.vehicle_response.estimators.joint_values import Estimates, Memory, System
from floatref.vehicle_response.estimators.observability import check_readings
from floatref.vehicle_response.models.model import Tyre, VehicleModel
from floatref.vehicle_response.models.outputs import Reading, output_matrices
from floatref.vehicle_response.models.state_space import Discrete, Hold, discretize


def with_tyre_states(model: VehicleModel, discrete: Discrete) -> Discrete:
    """Return ``discrete`` with a state u, in m, for each tyre of ``model`` that has damping.

    They come behind x, in the order of the tyres. Each is exact for forces that change linearly
    between samples, for any forces of ``discrete``: if they were held, u would lag.
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
    """Return the share of u that remains over a step, and what 1 N before and after it give."""
    steps = tyre.stiffness * step_s / tyre.damping
    lost = -expm1(-steps)
    # 1 - lost/steps, by its series where the difference would be rounding.
    ramp = steps / 2 - steps**2 / 6 + steps**3 / 24 if steps < 1e-4 else 1.0 - lost / steps
    return 1.0 - lost, (lost - ramp) / tyre.stiffness, ramp / tyre.stiffness


UNKNOWN_ROAD_M, UNKNOWN_ROAD_S = 0.1, 0.1
"""1-σ of how far the road is from where it was last seen, while no reading measures it, and after
which time that has changed: (15) of Zhu for a road of class G of ISO 8608 at 15 m/s."""
LOP_SIDED = 1e-9
"""Of its largest element, how far a covariance may be from symmetric or positive: rounding."""


@dataclass(frozen=True, eq=False)
class JointInputState:
    """Forces, road and states from m readings of a model with n freedoms on p tyres.

    Attributes:
        model: the vehicle.
        readings: what each column of the samples is.
        system: the model from sample to sample.
        initial: covariance of the states before the first sample.
    """

    model: VehicleModel
    readings: tuple[Reading, ...]
    system: System
    initial: FloatArray

    @classmethod
    def of(
        cls,
        model: VehicleModel,
        readings: Sequence[Reading],
        step_s: float,
        disturbance: ArrayLike,
        initial: ArrayLike,
        hold: Hold = Hold.ZERO_ORDER,
    ) -> "JointInputState":
        """Return the filter for samples ``step_s`` apart; it begins with all states at 0.

        ``disturbance`` is Q, of one step, and ``initial`` P of the first sample; both have the
        shape (2n, 2n), or (2n,) for a diagonal, in squares of m, rad, m/s and rad/s. With a
        ``hold`` of first order forces are linear between samples. Raises InputError for a step
        that is not above zero, an invalid covariance, or readings that do not determine all forces
        and states, naming what is missing.
        """
        check_readings(model, readings, step_s, hold)
        size = 2 * len(model.freedoms)
        noise = _covariance(model, "the disturbance", disturbance, size)
        start = _covariance(model, "the initial covariance", initial, size)
        discrete = with_tyre_states(model, discretize(model, step_s, hold))
        unseen = np.zeros(discrete.transition.shape[0] - size)
        output, direct = output_matrices(model, readings)
        output = np.hstack([output, np.zeros((len(readings), unseen.size))])
        system = System(
            transition=discrete.transition,
            influence=discrete.input,
            output=output,
            direct=direct,
            feedthrough=discrete.feedthrough(output, direct),
            variance=np.array([reading.sigma**2 for reading in readings]),
            disturbance=_extend(noise, unseen),
            after=discrete.after,
            unknown=np.array([(tyre.stiffness * UNKNOWN_ROAD_M) ** 2 for tyre in model.tyres]),
            stays=exp(-step_s / UNKNOWN_ROAD_S),
        )
        return cls(model, tuple(readings), system, _extend(start, unseen + UNKNOWN_ROAD_M**2))

    def estimate(self, samples: ArrayLike) -> Estimate:
        """Return the estimates from ``samples``, shape (N, m); a missing (NaN) reading is left out.

        Where the others do not determine all forces, force and road are NaN; the states go on with
        the last forces, and their standard deviations take in a rough road about 0.1 m away. Raises
        InputError for another shape, when no sample determines the forces, or when the
        covariance does not stay finite and positive.
        """
        array = self._check(samples)
        found = self.advance(self.begin(), array)
        if not np.isfinite(found.road).any():
            whole = zip(self.readings, array.T, strict=True)
            named = [str(r) for r, column in whole if not np.isfinite(column).any()]
            raise InputError(
                f"model {self.model.name}: no sample of {array.shape[0]} has all readings that "
                f"determine the forces of its tyres; missing throughout: {', '.join(named) or '-'}"
            )
        return found

    def begin(self) -> Memory:
        """Return the memory of a run, which `advance` writes; a deep copy goes on likewise."""
        states, inputs = self.system.after.shape
        return Memory(
            state=np.zeros(states),
            covariance=self.initial.copy(),
            force=np.zeros(inputs),
            spread=np.zeros((inputs, inputs)),
            crossed=np.zeros((states, inputs)),
        )

    def advance(self, memory: Memory, samples: ArrayLike) -> Estimate:
        """Return the estimates from ``samples``, shape (N, m), which follow the last ones.

        Any split gives the same, bit for bit. Raises InputError as `estimate`, but for samples
        that tell nothing.
        """
        from floatref.vehicle_response.estimators.joint_kernel import joint_input_state

        array = self._check(samples)
        count, (states, inputs) = array.shape[0], self.system.after.shape
        shapes = [(count, inputs)] * 2 + [(count, states)] * 2
        out = Estimates(*(np.empty(shape) for shape in shapes))
        done = joint_input_state(array, self.system, memory, out)
        if done < count:
            raise InputError(
                f"model {self.model.name}: the covariance is no longer finite and positive at "
                f"sample {done} of {count}; give a smaller initial covariance or step"
            )
        return self._estimate(out)

    def _estimate(self, found: Estimates) -> Estimate:
        size = 2 * len(self.model.freedoms)
        states_sigma = np.sqrt(np.maximum(found.states_variance, 0.0))
        force_sigma = np.sqrt(found.force_variance)
        road, road_sigma = np.empty_like(found.forces), np.empty_like(found.forces)
        place = size
        for column, tyre in enumerate(self.model.tyres):
            if tyre.damping > 0:
                known = np.isfinite(found.forces[:, column])
                road[:, column] = np.where(known, found.states[:, place], np.nan)
                road_sigma[:, column] = np.where(known, states_sigma[:, place], np.nan)
                place += 1
            else:
                road[:, column] = found.forces[:, column] / tyre.stiffness
                road_sigma[:, column] = force_sigma[:, column] / tyre.stiffness
        states, sigma = found.states[:, :size], states_sigma[:, :size]
        return Estimate(road, road_sigma, states, sigma, found.forces, force_sigma)

    def _check(self, samples: ArrayLike) -> FloatArray:
        array = np.ascontiguousarray(samples, dtype=np.float64)
        if array.ndim != 2 or array.shape[1] != len(self.readings):
            raise InputError(
                f"model {self.model.name}: samples of the shape {array.shape}; "
                f"{len(self.readings)} readings need (N, {len(self.readings)})"
            )
        return array if array.flags.writeable else array.copy()


def _extend(matrix: FloatArray, diagonal: FloatArray) -> FloatArray:
    """Return ``matrix`` with ``diagonal`` below it, zero beside."""
    size = matrix.shape[0]
    whole = np.diag(np.concatenate((np.zeros(size), diagonal)))
    whole[:size, :size] = matrix
    return whole


def _covariance(model: VehicleModel, name: str, given: ArrayLike, size: int) -> FloatArray:
    """Return ``given`` as a matrix; InputError unless it is a covariance of ``size`` states."""
    matrix = np.asarray(given, dtype=np.float64)
    matrix = np.diag(matrix) if matrix.shape == (size,) else matrix
    if matrix.shape != (size, size):
        raise InputError(
            f"model {model.name}: {name} has the shape {matrix.shape}; "
            f"{size} states need ({size}, {size}), or ({size},) for a diagonal"
        )
    if not np.isfinite(matrix).all():
        raise InputError(f"model {model.name}: {name} holds what is no finite number; check it")
    # Freedoms differ in unit and size, so each is measured by its own variance.
    own = np.diag(matrix)
    negative = bool((own < 0).any())
    scale = np.sqrt(np.where(own > 0, own, 1.0))
    scaled = matrix / scale / scale[:, None]
    lop_sided = np.abs(scaled - scaled.T).max() > LOP_SIDED
    if negative or lop_sided or np.linalg.eigvalsh(scaled)[0] < -LOP_SIDED:
        raise InputError(
            f"model {model.name}: {name} is no covariance; "
            "give a symmetric matrix without negative eigenvalues"
        )
    return 0.5 * matrix + 0.5 * matrix.T
