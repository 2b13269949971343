"""The data from which the oracle measures a value again.

Each kind of evidence computes the expected value with the functions of the reference
implementation.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray


class Reference(Protocol):
    """The measures of the dissertation's section 2.1 as the reference implements them."""

    def iri(self, elevation: FloatArray, interval_m: float) -> float:
        """Return the IRI in m/km of elevations in m."""

    def iri_trace(self, elevation: FloatArray, interval_m: float) -> FloatArray:
        """Return the signed output of the IRI filter in m/km, one value per interval."""

    def score(self, p: FloatArray, q: FloatArray, lag: int) -> float:
        """Return (2.16) of two filtered signals at an offset of ``lag`` samples."""


class Evidence(Protocol):
    """Data from which a measured value can be computed again."""

    def value(self, reference: Reference) -> float:
        """Return the value by ``reference``."""


@dataclass(frozen=True, eq=False)
class Roughness:
    """The elevations in m, at ``interval_m``, whose IRI in m/km was measured."""

    elevation: FloatArray
    interval_m: float

    def value(self, reference: Reference) -> float:
        """Return the IRI in m/km."""
        return reference.iri(self.elevation, self.interval_m)


@dataclass(frozen=True, eq=False)
class Pair:
    """Truth and result in m on the same points, and the intervals that are counted.

    Attributes:
        truth: filtered as the result is, shape (n,).
        result: as delivered, shape (n,).
        interval_m: between points.
        counted: which of the n - 1 intervals are counted.
    """

    truth: FloatArray
    result: FloatArray
    interval_m: float
    counted: BoolArray

    def traces(self, reference: Reference) -> tuple[FloatArray, FloatArray]:
        """Return the signed IRI filter outputs of both over the counted intervals, in m/km."""
        true, found = (
            np.asarray(reference.iri_trace(z, self.interval_m), dtype=np.float64)
            for z in (self.truth, self.result)
        )
        return true[self.counted], found[self.counted]


@dataclass(frozen=True, eq=False)
class RoughnessError:
    """The difference of the mean rectified outputs, in m/km or in percent of the truth's mean."""

    pair: Pair
    percent: bool

    def value(self, reference: Reference) -> float:
        """Return the magnitude of the error."""
        true, found = (float(np.abs(t).mean()) for t in self.pair.traces(reference))
        return abs(found - true) * (100.0 / true if self.percent else 1.0)


@dataclass(frozen=True, eq=False)
class CorrelationLoss:
    """One minus the agreement of both outputs at an offset of ``lag`` points."""

    pair: Pair
    lag: int

    def value(self, reference: Reference) -> float:
        """Return the loss, 0 to 2."""
        true, found = self.pair.traces(reference)
        return 1.0 - reference.score(true, found, self.lag)
