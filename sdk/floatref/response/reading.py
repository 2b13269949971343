"""What is measured of a model: accelerations, velocities, displacements of its freedoms."""

from dataclasses import dataclass
from enum import Enum
from math import isfinite

from floatref.errors import InputError


class Kind(Enum):
    """The derivative of a coordinate that a sensor tells: the rows of S_d, S_v, S_a (10) of Zhu."""

    DISPLACEMENT = 0
    VELOCITY = 1
    ACCELERATION = 2


@dataclass(frozen=True)
class Reading:
    """One measured signal of a model.

    Attributes:
        kind: which derivative.
        freedom: name of the coordinate.
        sigma: standard deviation of one sample, in the unit of the signal.
        minus: name of a coordinate whose derivative is taken off, as of a suspension deflection;
            "" is none.
    """

    kind: Kind
    freedom: str
    sigma: float
    minus: str = ""

    def __post_init__(self) -> None:
        """Refuse a standard deviation that is none, and what is measured against itself."""
        if not (isfinite(self.sigma) and self.sigma > 0):
            raise InputError(f"{self}: sigma is {self.sigma:g}; give a number above zero")
        if self.minus == self.freedom:
            raise InputError(f"{self}: a freedom against itself tells nothing; name another")

    def __str__(self) -> str:
        """Return it in words, as in "acceleration of the front wheel"."""
        other = f" against the {self.minus}" if self.minus else ""
        return f"{self.kind.name.lower()} of the {self.freedom}{other}"
