"""The road as an unknown input: the equations (8)-(15) of Imine for any model.

Put into (8), the tyre equation (9) takes the road out of the states: with it, every wheel has the
acceleration that is measured. Both are here without a division by the tyre's damping c, so that
the limit c = 0 is exact; there (9) is u = (m·z'' + …)/k and the road no state.
"""

from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.kernels.compiling import compiled
from floatref.values.arrays import BoolArray, FloatArray, new_record
from floatref.vehicle_response.models.model import VehicleModel
from floatref.vehicle_response.models.state_space import state_space


class ObserverEquations(NamedTuple):
    """(10) and (11) of Imine in one: state (x, u of damped tyres), s of them; inputs (y, z'').

    Attributes:
        error: L of (12) to (14) of Imine, shape (s, s), in 1/s with the units of the states.
        inputs: of y and z'' into the rate of the state, shape (s, k + p).
        road_of_state: shape (p, s).
        road_of_input: shape (p, k + p).
    """

    error: FloatArray
    inputs: FloatArray
    road_of_state: FloatArray
    road_of_input: FloatArray


def observer_equations(
    model: VehicleModel, gain: FloatArray, outputs: FloatArray
) -> ObserverEquations:
    """Return (10) and (11) of Imine, from (8) and (9) of Imine, and L of (12) to (14) of Imine.

    ``gain`` is G, shape (2n, k), ``outputs`` is C' of y = C'x, shape (k, 2n).

    Raises InputError for a model in which the force of a tyre does not move its wheel alone.
    """
    forces, masses = wheel_equations(model)
    rates, pushed = state_space(model)
    damped = damped_tyres(model)
    states, measured, damping = 2 * len(model.freedoms), outputs.shape[0], _tyres(model)[1][damped]
    size = states + damping.size
    error, inputs = np.zeros((size, size)), np.zeros((size, measured + masses.size))
    error[:states, :states] = rates + pushed @ forces - gain @ outputs
    error[states:, :states] = forces[damped] / damping[:, None]
    error[states:, states:] = -np.diag(_tyres(model)[0][damped] / damping)
    inputs[:states, :measured] = gain
    inputs[:states, measured:] = pushed * masses
    inputs[states:, measured:] = np.diag(masses)[damped] / damping[:, None]
    return ObserverEquations(error, inputs, *_road(model, forces, masses, measured))


def wheel_equations(model: VehicleModel) -> tuple[FloatArray, FloatArray]:
    """Return W (p, 2n) and m (p,) of (9) of Imine times c: c·u' + k·u = m·z'' + W·x.

    Raises InputError if two tyres carry one freedom, or a wheel's mass is coupled to another's.
    """
    wheels = [model.index(tyre.freedom) for tyre in model.tyres]
    rows = model.mass[wheels]
    for tyre, wheel, row in zip(model.tyres, wheels, rows, strict=True):
        if wheels.count(wheel) > 1 or np.count_nonzero(row) > 1:
            raise InputError(
                f"model {model.name}: the {tyre.freedom} has more than one tyre, or shares its "
                "mass with another freedom, so its acceleration does not give the road; give it a "
                "coordinate and a mass of its own"
            )
    return np.hstack([model.stiffness[wheels], model.damping[wheels]]), rows.sum(axis=1)


def damped_tyres(model: VehicleModel) -> BoolArray:
    """Return which tyres have damping, so that the road under them is a state; shape (p,)."""
    return _tyres(model)[1] > 0


def _tyres(model: VehicleModel) -> tuple[FloatArray, FloatArray]:
    stiffness = np.array([tyre.stiffness for tyre in model.tyres])
    return stiffness, np.array([tyre.damping for tyre in model.tyres])


def _road(
    model: VehicleModel, forces: FloatArray, masses: FloatArray, measured: int
) -> tuple[FloatArray, FloatArray]:
    stiffness, damped = _tyres(model)[0], damped_tyres(model)
    still = ~damped / stiffness
    of_state = np.hstack([forces * still[:, None], np.eye(masses.size)[:, damped]])
    of_input = np.hstack([np.zeros((masses.size, measured)), np.diag(masses * still)])
    return of_state, of_input


COURSE = np.dtype([("started", np.bool_), ("broken", np.int64), ("settling", np.int64)], align=True)
"""Whether the estimate has begun, in how many samples the newest inputs are whole, and in how many
the error has decayed."""


class ObserverMemory(NamedTuple):
    """What `observe` remembers between blocks.

    Attributes:
        course: of `COURSE`.
        held: the newest inputs, the last sample first, shape (d, m).
        state: the last one, shape (s,).
    """

    course: np.record
    held: FloatArray
    state: FloatArray

    @classmethod
    def of(cls, taps: FloatArray) -> "ObserverMemory":
        """Return that of a stream that has not begun, for the ``taps`` of `observe`."""
        _, samples, states, inputs = taps.shape
        return cls(new_record(COURSE), np.zeros((samples, inputs)), np.zeros(states))


@compiled
def observe(
    transition: FloatArray,
    taps: FloatArray,
    start: FloatArray,
    road_of_state: FloatArray,
    road_of_input: FloatArray,
    settling: int,
    inputs: FloatArray,
    memory: ObserverMemory,
    states: FloatArray,
    road: FloatArray,
    settled: BoolArray,
) -> None:
    """Write state and road by (10) and (11) of Imine, and whether the start's error has decayed.

    ``transition`` (2, s, s) acts on the last state, ``taps`` (2, d, s, m) on the inputs of the
    sample and of those before it; the second of each has no innovation. ``start`` (s, m) makes
    the first state of the first sample without absent values; up to there all is NaN. The road
    is ``road_of_state`` (p, s) and ``road_of_input`` (p, m) of both. ``settling`` samples in a
    row without absent values make an estimate settled. ``inputs`` has the shape (N, m), NaN is
    absent; ``states`` (N, s), ``road`` (N, p).
    """
    course, held, state = memory
    for i in range(inputs.shape[0]):
        absent = _is_absent(inputs[i])
        if not course.started and absent:
            states[i] = road[i] = float("nan")
            settled[i] = False
            continue
        course.broken = held.shape[0] if absent else max(course.broken - 1, 0)
        course.settling = settling if absent else max(course.settling - 1, 0)
        if not course.started:
            course.started, course.settling = True, settling
            held[:] = inputs[i]
            _multiply(start, held[0], states[i], False)
        else:
            which = 0 if course.broken == 0 else 1
            held[1:] = held[:-1].copy()
            _hold(inputs[i], held[0])
            _multiply(transition[which], state, states[i], False)
            for j in range(held.shape[0]):
                _multiply(taps[which, j], held[j], states[i], True)
        state[:] = states[i]
        _multiply(road_of_state, state, road[i], False)
        _multiply(road_of_input, held[0], road[i], True)
        settled[i] = course.settling == 0


@compiled
def _is_absent(values: FloatArray) -> bool:
    absent = False
    for value in values:
        absent = absent or value != value
    return absent


@compiled
def _hold(values: FloatArray, held: FloatArray) -> None:
    for j in range(values.size):
        if values[j] == values[j]:
            held[j] = values[j]


@compiled
def _multiply(matrix: FloatArray, vector: FloatArray, result: FloatArray, add: bool) -> None:
    for row in range(matrix.shape[0]):
        total = result[row] if add else 0.0
        for column in range(matrix.shape[1]):
            total += matrix[row, column] * vector[column]
        result[row] = total
