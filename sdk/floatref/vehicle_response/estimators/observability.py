"""Whether readings determine the forces of the tyres and the states; which sensor is missing."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.models.model import VehicleModel
from floatref.vehicle_response.models.outputs import Kind, Reading, output_matrices, selection
from floatref.vehicle_response.models.state_space import Discrete, Hold, discretize

NOTHING = 1e-9
"""Singular value of a matrix with rows and columns of about 1 that counts as rounding."""
CIRCLE = 1e-6
"""Distance from 1 within which a zero neither grows nor decays in a drive, and may be exactly 1."""
ROUNDS = 20

Matrix = NDArray[Any]


def null_space(matrix: Matrix) -> Matrix:
    """Return the directions that ``matrix`` takes to zero, as columns, shape (columns, nullity).

    Rows and columns are scaled to about 1 before, so that units have no influence; the columns
    returned are those of the given matrix.
    """
    balanced, scale = _balance(matrix)
    _, sizes, rows = np.linalg.svd(balanced)
    rank = int(np.sum(sizes > NOTHING))
    return np.asarray(scale[:, None] * rows[rank:].conj().T)


def lasting_motions(
    system: Discrete, output: FloatArray, direct: FloatArray
) -> list[tuple[complex, Matrix]]:
    """Return the invariant zeros λ of (A_c, B_c, G, J) on or outside the unit circle.

    For such λ there are a state x and forces F with A_c·x + B_c·F = λ·x and G·x + J·F = 0: a
    motion that goes as λᵏ, stays or grows, and that no reading shows. With each λ come its
    (x, F) as columns, shape (2n + p, k). For J of full column rank the zeros are among the
    eigenvalues of A_c - B_c·J⁺·G; 1 is tried besides, since a multiple one is computed inexactly.
    J is that of the hold, `Discrete.feedthrough`.
    """
    rows = 1.0 / _lengths(np.hstack([output, direct]), 1)[:, None]
    closed = system.transition - system.input @ np.linalg.pinv(rows * direct) @ (rows * output)
    candidates = np.linalg.eigvals(closed)
    tried = [1.0, *candidates[np.abs(candidates) > 1.0 - CIRCLE]]
    motions = [(z, null_space(_pencil(system, output, direct, z))) for z in tried]
    return [(z, motion) for z, motion in motions if motion.size]


def unseen_modes(system: Discrete, output: FloatArray) -> list[Matrix]:
    """Return the states x with A_c·x = λ·x and G·x = 0, shape (2n, k) for each of the λ."""
    nothing = np.zeros((len(output), 0))
    eigenvalues = [1.0, *np.linalg.eigvals(system.transition)]
    spaces = [null_space(_pencil(system, output, nothing, z)) for z in eigenvalues]
    return [space for space in spaces if space.size]


def _pencil(system: Discrete, output: FloatArray, direct: FloatArray, z: complex) -> Matrix:
    """Return [A_c - z·I, B_c; G, J], without B_c where J has no columns."""
    states = len(system.transition)
    above = np.hstack([system.transition - z * np.eye(states), system.input[:, : direct.shape[1]]])
    return np.vstack([above, np.hstack([output, direct])])


def _balance(matrix: Matrix) -> tuple[Matrix, FloatArray]:
    """Return ``matrix`` with rows and columns of length about 1, and the scale of columns."""
    balanced, scale = np.array(matrix), np.ones(matrix.shape[1])
    for _ in range(ROUNDS):
        balanced = balanced / _lengths(balanced, 1)[:, None]
        columns = _lengths(balanced, 0)
        balanced, scale = balanced / columns, scale / columns
    return balanced, scale


def _lengths(matrix: Matrix, axis: int) -> FloatArray:
    lengths = np.linalg.norm(matrix, axis=axis)
    return np.where(lengths > 0, lengths, 1.0)


SHARE = 1e-6
"""Share of the largest component of a direction below which a component counts as zero."""


def check_readings(
    model: VehicleModel,
    readings: Sequence[Reading],
    step_s: float,
    hold: Hold = Hold.ZERO_ORDER,
) -> None:
    """Raise InputError, naming the missing sensor, unless ``readings`` give forces and states.

    Needed are J of (11) of Zhu of full column rank, for step (a), and no invariant zero on or
    outside the unit circle: else an error of the estimated road stays, or grows. ``step_s`` is
    the time between samples, in s.

    J is that of forces that stay, for either hold. With forces that change linearly a displacement
    depends on them, too, by about step²/(6·m) in m/N: its noise would be 6·m/step² times larger in
    force.
    """
    _check_felt(model, unfelt_tyres(model, readings))
    _check_heights(model, missing_displacements(model, readings))
    output, direct = output_matrices(model, readings)
    system = discretize(model, step_s, hold)
    motions = lasting_motions(system, output, system.feedthrough(output, direct))
    if motions:
        moving = " and the ".join(_moving(model, [motion for _, motion in motions]))
        raise InputError(
            f"model {model.name}: with steps of {step_s:g} s the readings leave a motion of the "
            f"{moving} unknown that does not decay; add a reading of it, or shorten the step"
        )


def unfelt_tyres(model: VehicleModel, readings: Sequence[Reading]) -> tuple[str, ...]:
    """Return the freedoms whose tyre's force is unknown: those that lower the rank of J."""
    _, direct = output_matrices(model, readings)
    largest = np.abs(null_space(direct)).max(axis=1, initial=0.0)
    unfelt = np.flatnonzero(largest > SHARE * largest.max())
    return tuple(model.tyres[at].freedom for at in unfelt)


def missing_displacements(model: VehicleModel, readings: Sequence[Reading]) -> tuple[str, ...]:
    """Return the freedoms whose displacements would show the unseen states at rest.

    At rest K·q = S·F, and accelerations and velocities are zero: only displacements, the rows S_d
    of (10) of Zhu, show such q and F. Without them there is an invariant zero at 1, where twice
    integrated accelerations drift. The wheels come first, then the other useful freedoms.
    """
    wheels = [tyre.freedom for tyre in model.tyres]
    others = sorted((f for f in model.freedoms if f.name not in wheels), key=lambda f: f.angular)
    measured = [r for r in readings if r.kind is Kind.DISPLACEMENT]
    unseen, missing = _resting_unseen(model, measured), []
    for name in (*wheels, *(f.name for f in others)):
        tried = [*measured, Reading(Kind.DISPLACEMENT, name, sigma=1.0)]
        left = _resting_unseen(model, tried)
        if left < unseen:
            measured, unseen = tried, left
            missing.append(name)
    return tuple(missing)


def unseen_freedoms(
    model: VehicleModel, readings: Sequence[Reading], step_s: float
) -> tuple[str, ...]:
    """Return the freedoms that move in motions that no reading shows if the forces are known.

    Empty if (A_c, G) is observable.
    """
    output, _ = output_matrices(model, readings)
    return _moving(model, unseen_modes(discretize(model, step_s), output))


def _moving(model: VehicleModel, motions: Sequence[Matrix]) -> tuple[str, ...]:
    """Return the freedoms that move in ``motions``, whose first rows are the coordinates q."""
    seen = set[int]()
    for motion in motions:
        largest = np.abs(motion[: len(model.freedoms)]).max(axis=1)
        seen |= set(np.flatnonzero(largest > SHARE * largest.max()).tolist())
    return tuple(model.freedoms[at].name for at in sorted(seen))


def _resting_unseen(model: VehicleModel, displacements: Sequence[Reading]) -> int:
    """Return how many directions of (q, F) with K·q = S·F the readings leave at zero."""
    balance = np.hstack([model.stiffness, -model.selection])
    shown = selection(model, displacements)
    rows = np.hstack([shown, np.zeros((len(shown), len(model.tyres)))])
    return int(null_space(np.vstack([balance, rows])).shape[1])


def _check_felt(model: VehicleModel, unfelt: tuple[str, ...]) -> None:
    if unfelt:
        sensors = " and the ".join(f"acceleration of the {name}" for name in unfelt)
        raise InputError(
            f"model {model.name}: no reading responds at once to the force of the tyre of the "
            f"{' and of the '.join(unfelt)}: J has not full column rank; add the {sensors}"
        )


def _check_heights(model: VehicleModel, missing: tuple[str, ...]) -> None:
    if missing:
        sensors = " and the ".join(f"displacement of the {name}" for name in missing)
        raise InputError(
            f"model {model.name}: the readings do not determine all heights and angles at rest, so "
            f"the estimate would drift; add the {sensors}"
        )
