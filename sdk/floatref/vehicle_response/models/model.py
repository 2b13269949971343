"""A linear model of a vehicle on its tyres: M·q'' + C·q' + K·q = S·F, (7) of Zhu and of Imine.

F holds the forces F = k·u + c·u' in N that the road u, in m, exerts through the tyres of
stiffness k and damping c; these are also part of K and C.
"""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray

ASYMMETRIC = 1e-9
"""Rounding error of symmetry and of eigenvalues, as a share of the largest element."""


@dataclass(frozen=True)
class Freedom:
    """One coordinate of a model.

    Attributes:
        name: in messages, in the field's words: "body", "front wheel".
        symbol: of the paper.
        quantity: how its channels begin: "sprung", "unsprung", "pitch".
        angular: whether it is an angle in rad, else a height in m.
        sign: of the recording's channel for a positive coordinate, 1 or -1.
        track: wheel path that its channels belong to; "" is the estimated one, or no wheel path.
    """

    name: str
    symbol: str
    quantity: str
    angular: bool = False
    sign: float = 1.0
    track: str = ""


@dataclass(frozen=True)
class Tyre:
    """A tyre between the road and one freedom.

    Attributes:
        freedom: name of the wheel's freedom.
        stiffness: in N/m.
        damping: in N·s/m.
        x_m: position ahead of the model's own point, in m.
        track: wheel path of the road under it; "" is the estimated one.
    """

    freedom: str
    stiffness: float
    damping: float = 0.0
    x_m: float = 0.0
    track: str = ""


@dataclass(frozen=True, eq=False)
class VehicleModel:
    """Freedoms, tyres and the matrices of n freedoms on p tyres.

    Attributes:
        name: of the model, in messages.
        freedoms: the coordinates q, n of them.
        tyres: p of them, in the order of F.
        mass: M, shape (n, n), in kg and kg·m².
        damping: C with the tyres' part, shape (n, n), in N·s/m, N·s and N·m·s.
        stiffness: K with the tyres' part, shape (n, n), in N/m, N and N·m.
    """

    name: str
    freedoms: tuple[Freedom, ...]
    tyres: tuple[Tyre, ...]
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray

    def __post_init__(self) -> None:
        """Refuse an impossible vehicle; InputError names matrix, value and remedy."""
        self._check_names()
        for name in ("mass", "damping", "stiffness"):
            matrix = np.asarray(getattr(self, name), dtype=np.float64)
            self._check_shape(name, matrix)
            self._check_symmetry(name, matrix)
            object.__setattr__(self, name, _frozen_matrix(matrix))
        for tyre in self.tyres:
            self._check_tyre(tyre)
        self._check_mass()
        for name in ("damping", "stiffness"):
            self._check_energy(name)

    @property
    def selection(self) -> FloatArray:
        """S, shape (n, p): 1 where a tyre pushes a freedom."""
        matrix = np.zeros((len(self.freedoms), len(self.tyres)))
        for column, tyre in enumerate(self.tyres):
            matrix[self.index(tyre.freedom), column] = 1.0
        return matrix

    def index(self, freedom: str) -> int:
        """Return the place of ``freedom``, by name, in q; InputError if it does not exist."""
        names = [f.name for f in self.freedoms]
        if freedom not in names:
            known = ", ".join(names)
            raise InputError(f"model {self.name}: no freedom {freedom!r}; it has {known}")
        return names.index(freedom)

    def _check_shape(self, name: str, matrix: FloatArray) -> None:
        size = len(self.freedoms)
        if matrix.shape != (size, size):
            raise InputError(
                f"model {self.name}: {name} has the shape {matrix.shape}; "
                f"{size} freedoms need ({size}, {size})"
            )
        if not np.isfinite(matrix).all():
            raise InputError(f"model {self.name}: {name} has a value that is not finite; check it")

    def _check_symmetry(self, name: str, matrix: FloatArray) -> None:
        if float(np.abs(matrix - matrix.T).max()) > ASYMMETRIC * float(np.abs(matrix).max()):
            raise InputError(
                f"model {self.name}: {name} is not symmetric, so it would generate energy; "
                "check its signs"
            )

    def _check_names(self) -> None:
        names = [freedom.name for freedom in self.freedoms]
        if not names or not self.tyres or len(set(names)) != len(names):
            raise InputError(
                f"model {self.name}: {len(self.tyres)} tyres and the freedoms "
                f"{', '.join(names) or '-'}; give a tyre or more, and every freedom a name of "
                "its own"
            )

    def _check_tyre(self, tyre: Tyre) -> None:
        self.index(tyre.freedom)
        right = tyre.stiffness > 0 and tyre.damping >= 0
        if not (right and np.isfinite([tyre.stiffness, tyre.damping, tyre.x_m]).all()):
            raise InputError(
                f"model {self.name}: the tyre of the {tyre.freedom} has stiffness "
                f"{tyre.stiffness:g} N/m, damping {tyre.damping:g} N·s/m, x_m {tyre.x_m:g}; give "
                "finite numbers, the stiffness above zero and the damping not below"
            )

    def _check_mass(self) -> None:
        least = float(np.linalg.eigvalsh(self.mass)[0])
        if least <= 0:
            raise InputError(
                f"model {self.name}: mass has the eigenvalue {least:.3g}; it must be above zero, "
                "check every mass"
            )

    def _check_energy(self, name: str) -> None:
        """Raise InputError if the matrix without the tyres' part generates energy."""
        matrix, tyres = getattr(self, name), [getattr(tyre, name) for tyre in self.tyres]
        rest = matrix - self.selection * tyres @ self.selection.T
        least = float(np.linalg.eigvalsh(rest)[0])
        if least < -ASYMMETRIC * float(np.abs(matrix).max()):
            raise InputError(
                f"model {self.name}: {name} without the tyres has the eigenvalue {least:.3g}, so "
                "it would generate energy; check its signs, and that it includes the tyres' part"
            )


def _frozen_matrix(matrix: FloatArray) -> FloatArray:
    copy = np.array(matrix)
    copy.flags.writeable = False
    return copy
