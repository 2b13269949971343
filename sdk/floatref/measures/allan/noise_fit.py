"""Coefficients of noise from an Allan deviation: the curve of IEEE Std 952 (6.53), fitted."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.measures.allan.deviation import AllanDeviation, AllanScatter
from floatref.values.arrays import FloatArray

MODEL_ERROR = 0.05
"""No sensor follows (6.53) better than to this share of the variance, however long the signal."""
CONFIDENCE = 3.0
"""Standard deviations by which the data must contradict the curve without a term to keep it."""
LIMIT = 2.0
"""Standard deviations of the upper limit of a term that was removed."""
FEWEST_TIMES = 8
"""Cluster times that a fit takes."""
SURE = 30.0
"""Fewest degrees of freedom of a deviation whose misfit is reported."""
ROUNDS = 40
CONVERGED = 1e-10
LEAST = 1e-3
"""Lowest value of the curve while it is fitted, as a share of the measured variance."""


class NoiseCoefficients(NamedTuple):
    """Coefficients of (6.53) for a signal in the unit u, 0 for a term that is not there.

    Args:
        ramp: R_A, in u/s.
        random_walk: K_A, of the bias, in u/√s.
        bias_instability: B_A, in u.
        white_noise: N_A, a density in u/√Hz; sampled at f it has the standard deviation N_A √f.
        quantization: Q_A, of the integrated signal, in u·s.
    """

    ramp: float = 0.0
    random_walk: float = 0.0
    bias_instability: float = 0.0
    white_noise: float = 0.0
    quantization: float = 0.0

    def deviation(self, cluster_s: FloatArray) -> FloatArray:
        """Return the Allan deviation (6.53) for cluster times ``cluster_s`` in s."""
        deviation: FloatArray = np.sqrt(_columns(cluster_s) @ np.square(self))
        return deviation


@dataclass(frozen=True, eq=False)
class NoiseFit:
    """The curve (6.53) through an Allan deviation.

    ``coefficients`` have the standard ``uncertainties``. A term that the data do not support is
    0, and may be as large as ``limits`` all the same, which are NaN for the terms that are there.
    ``scatter``, shape (n,), is the relative standard uncertainty of every measured deviation.
    """

    allan: AllanDeviation
    coefficients: NoiseCoefficients
    uncertainties: NoiseCoefficients
    limits: NoiseCoefficients
    scatter: FloatArray

    @property
    def deviation(self) -> FloatArray:
        """The fitted deviation, shape (n,)."""
        return self.coefficients.deviation(self.allan.cluster_s)

    def dominates(self, term: str) -> tuple[float, float] | None:
        """Return the cluster times in s from and to which ``term`` is the largest, or None."""
        shares = _columns(self.allan.cluster_s) * np.square(self.coefficients)
        largest = shares.argmax(axis=1) == NoiseCoefficients._fields.index(term)
        where = self.allan.cluster_s[largest]
        return (float(where[0]), float(where[-1])) if where.size else None

    def worst(self) -> tuple[float, float]:
        """Return by which factor, 1 or more, curve and data differ most, and the time in s.

        Cluster times at which the data have fewer than 30 degrees of freedom do not count.
        """
        off = np.abs(np.log(self.allan.deviation / self.deviation))
        off[2.0 * SURE * self.scatter**2 > 1.0] = 0.0
        at = int(off.argmax())
        return float(np.exp(off[at])), float(self.allan.cluster_s[at])


def fit_noise(allan: AllanDeviation, confidence: float = CONFIDENCE) -> NoiseFit:
    """Return the curve (6.53) through ``allan`` by non-negative least squares.

    Every Allan variance counts by its relative uncertainty, which depends on its degrees of
    freedom. The term that the data support least is removed, then the next, until each remaining
    term is supported by ``confidence`` standard deviations; 0 keeps all terms. Raises InputError
    for fewer than 8 cluster times or a deviation that is not above zero.
    """
    if allan.clusters.size < FEWEST_TIMES:
        raise InputError(f"{allan.clusters.size} cluster times; a fit takes {FEWEST_TIMES} or more")
    if not (np.isfinite(allan.deviation).all() and (allan.deviation > 0).all()):
        raise InputError("an Allan deviation is not above zero; give a signal that has noise")
    curve = _Curve(allan)
    terms = curve.list_supported(confidence)
    squares = curve.fit_terms(terms)
    spread = curve.uncertainties(squares, terms)
    found = np.sqrt(squares)
    uncertainties = np.divide(spread, 2.0 * found, out=np.zeros(5), where=found > 0)
    limits = np.array([curve.limit(squares, terms, term) for term in range(5)])
    scatter = 0.5 * np.sqrt(curve.scatter.variance(squares)) / (curve.columns @ squares)
    return NoiseFit(
        allan,
        NoiseCoefficients(*(curve.unit * found).tolist()),
        NoiseCoefficients(*(curve.unit * uncertainties).tolist()),
        NoiseCoefficients(*(curve.unit * limits).tolist()),
        scatter,
    )


class _Curve:
    """Allan variances to be fitted, and the weighted problem of doing so."""

    def __init__(self, allan: AllanDeviation) -> None:
        time = allan.cluster_s
        # In a unit of its own, lest squares of squares leave the range of float64.
        self.unit = float(np.exp(np.mean(np.log(allan.deviation))))
        self.variance = np.square(allan.deviation / self.unit)
        self.columns = _columns(time)
        self.scatter = AllanScatter(allan)
        # What (6.53) misses, neighbours miss together.
        self.alike = np.minimum.outer(time, time) / np.maximum.outer(time, time)

    def list_supported(self, confidence: float) -> list[int]:
        """Return the terms that the data support."""
        terms = np.flatnonzero(self.fit_terms([0, 1, 2, 3, 4])).tolist()
        while len(terms) > 1:
            tests = [self._without(term, terms) for term in terms]
            least = min(range(len(terms)), key=tests.__getitem__)
            if tests[least] >= confidence:
                break
            del terms[least]
            terms = np.flatnonzero(self.fit_terms(terms)).tolist()
        return terms

    def fit_terms(self, terms: list[int]) -> FloatArray:
        """Return the squared coefficients, shape (5,), with ``terms`` alone above zero.

        Weights are those of the curve that is found, so that the fit is one of greatest
        likelihood and no estimate counts more because it happens to be small.
        """
        from scipy.optimize import nnls

        squares, curve, root = np.zeros(5), self.variance, 1.0 / self.variance
        for _ in range(ROUNDS):
            columns = self.columns[:, terms] * root[:, None]
            size = np.sqrt(np.sum(columns**2, axis=0))
            squares[terms] = nnls(columns / size, self.variance * root)[0] / size
            before, curve = curve, self._curve(squares)
            if np.abs(curve / before - 1.0).max() <= CONVERGED:
                break
            root = np.sqrt(self._weights(squares))
        return squares

    def uncertainties(self, squares: FloatArray, terms: list[int]) -> FloatArray:
        """Return the standard uncertainties of the squared coefficients, shape (5,)."""
        spread = np.zeros(5)
        spread[terms] = self._spread(self._solver(squares, terms), squares)
        return spread

    def limit(self, squares: FloatArray, terms: list[int], term: int) -> float:
        """Return the upper limit of ``term``, which was removed; NaN for a term of the fit."""
        if term in terms:
            return float("nan")
        estimate, spread = self._add_term(squares, terms, term)
        return float(np.sqrt(max(estimate, 0.0) + LIMIT * spread))

    def _without(self, term: int, terms: list[int]) -> float:
        """Return by how many standard deviations the data contradict a curve without ``term``."""
        rest = [t for t in terms if t != term]
        estimate, spread = self._add_term(self.fit_terms(rest), rest, term)
        return estimate / spread

    def _add_term(self, squares: FloatArray, terms: list[int], term: int) -> tuple[float, float]:
        """Return the square of ``term`` fitted with ``terms``, and its standard deviation at 0."""
        solver = self._solver(squares, [*terms, term])
        return float(solver[-1] @ self.variance), float(self._spread(solver, squares)[-1])

    def _solver(self, squares: FloatArray, terms: list[int]) -> FloatArray:
        """Return the matrix, shape (terms, n), from variances to squared coefficients."""
        weights = self._weights(squares)
        columns = self.columns[:, terms] * np.sqrt(weights)[:, None]
        size = np.sqrt(np.sum(columns**2, axis=0))
        inverse: FloatArray = np.linalg.pinv(columns / size) / size[:, None]
        return inverse * np.sqrt(weights)

    def _spread(self, solver: FloatArray, squares: FloatArray) -> FloatArray:
        """Return the standard deviations of the squared coefficients that ``solver`` gives."""
        noise = solver @ self.scatter.root(squares)
        missed = MODEL_ERROR * solver * self._curve(squares)
        spread: FloatArray = np.sqrt(
            np.sum(noise**2, axis=1) + np.sum(missed @ self.alike * missed, axis=1)
        )
        return spread

    def _weights(self, squares: FloatArray) -> FloatArray:
        missed = MODEL_ERROR * self._curve(squares)
        weights: FloatArray = 1.0 / (self.scatter.variance(squares) + missed**2)
        return weights

    def _curve(self, squares: FloatArray) -> FloatArray:
        return np.maximum(self.columns @ squares, LEAST * self.variance)


def _columns(cluster_s: FloatArray) -> FloatArray:
    """Return what multiplies each squared coefficient in (6.53), shape (n, 5)."""
    time = np.asarray(cluster_s, dtype=np.float64)
    flat = np.full(time.size, 2.0 * np.log(2.0) / np.pi)
    return np.stack([time**2 / 2.0, time / 3.0, flat, 1.0 / time, 3.0 / time**2], axis=1)
