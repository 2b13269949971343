"""One series as a sum of others, by least squares over the windows in which they agree."""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from floatref.screening.second_sensor.fast_series import STEP_S
from floatref.values.arrays import BoolArray, FloatArray

WINDOW_S = 0.5
"""Length of a window in s: a period of the body at 2 Hz."""
OUTLYING = 4.0
"""A window with this number of times the usual residual is left out of the fit."""
MOVING = 0.1
"""Share of the motion of lively windows with which a window counts."""
ROUNDS = 3
FEWEST_WINDOWS = 8
"""Fewest windows of a fit, 4 s."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A series as a sum of others.

    Attributes:
        weights: of the others, in their order.
        explained: share of the series' power that they explain, in windows that agree; 1 at most.
        left_over: share that they leave unexplained in all windows that count.
        residual: root mean square of what they leave in every window, shape (w,).
        power: the same of the series itself.
        counted: windows in which all is known and something moves, shape (w,).
        agree: those of them that agree, shape (w,).
        inverse: of the products of the others in windows that agree, times the power of the series,
            shape (k, k).
    """

    weights: FloatArray
    explained: float
    left_over: float
    residual: FloatArray
    power: FloatArray
    counted: BoolArray
    agree: BoolArray
    inverse: FloatArray

    def leverage(self, count: int) -> float:
        """Return by how much the sum of the first ``count`` weights may be wrong.

        Times the share of the series' size that its sensors are wrong by. Large where the others
        move together, so that the weights cannot be separated.
        """
        return float(np.sqrt(self.inverse[:count, :count].sum()))

    def loud(self, times: float, share: float) -> BoolArray:
        """Return the windows that count and do not agree, shape (w,).

        They leave ``times`` the usual residual, and ``share`` of the series, usual and own.
        """
        usual, size = (float(np.median(x[self.agree])) for x in (self.residual, self.power))
        least = np.maximum(times * usual, share * np.maximum(size, self.power))
        return np.asarray(self.counted & (self.residual > least))

    @property
    def agreeing(self) -> float:
        """Share of the windows that count that agree."""
        return float(self.agree.sum()) / float(self.counted.sum())


T = TypeVar("T", np.float64, np.bool_)


def windowed(rows: NDArray[T]) -> NDArray[T]:
    """Return ``rows``, shape (k, n), as windows, shape (k, w, m); the end of the run is cut."""
    size = round(WINDOW_S / STEP_S)
    count = rows.shape[1] // size
    return rows[:, : count * size].reshape(rows.shape[0], count, size)


def fit(series: FloatArray, others: FloatArray, known: BoolArray, least: float = 0.0) -> Fit | None:
    """Return ``series``, shape (n,), as a sum of ``others``, shape (k, n).

    Windows with a point that is not ``known`` do not count. None if fewer than `FEWEST_WINDOWS` do.
    Where less than ``least`` is explained, the first third of the run that explains as much gives
    the weights: a sensor that fails midway still works before.
    """
    rows = np.concatenate([series[None], others])
    parts, whole = windowed(rows), np.all(windowed(known[None])[0], axis=1)
    if whole.sum() < FEWEST_WINDOWS:
        return None
    products = np.einsum("iwm,jwm->wij", parts, parts) / parts.shape[2]
    whole = whole & _is_moving(products)
    found = _fit(products, whole, whole & _is_usual(products, whole), whole)
    if found is None or found.explained >= least:
        return found
    for third in np.array_split(np.flatnonzero(whole), 3):
        within = np.isin(np.arange(whole.size), third)
        tried = _fit(products, whole, within, within)
        if tried is not None and tried.explained >= least:
            return tried
    return found


def _is_moving(products: FloatArray) -> BoolArray:
    """Return the windows in which any of the series moves: a standstill shows noise alone."""
    power = np.sqrt(np.diagonal(products, axis1=1, axis2=2))
    usual = np.percentile(power, 90, axis=0)
    return np.asarray(np.any(power > MOVING * usual, axis=1))


def _is_usual(products: FloatArray, whole: BoolArray) -> BoolArray:
    """Return the windows in which no series is much larger than in half of those that count."""
    power = np.sqrt(np.diagonal(products, axis1=1, axis2=2))
    return np.asarray(np.all(power <= OUTLYING * np.median(power[whole], axis=0), axis=1))


def _fit(products: FloatArray, whole: BoolArray, first: BoolArray, within: BoolArray) -> Fit | None:
    """Return the fit that begins with the windows ``first`` and grows to all ``within`` that agree.

    ``products``, shape (w, 1 + k, 1 + k), are the mean products of the series and the others.
    """
    if first.sum() < FEWEST_WINDOWS:
        return None
    agree = first
    for _ in range(ROUNDS):
        weights = _solve(products[agree].sum(axis=0))
        signed = np.concatenate([[1.0], -weights])
        residual = np.sqrt(np.maximum(products @ signed @ signed, 0.0))
        usual = float(np.median(residual[agree]))
        agree = within & (residual <= OUTLYING * usual)
    power = np.sqrt(products[:, 0, 0])
    explained, left_over = 1.0 - _share(residual, power, agree), _share(residual, power, whole)
    agree = whole & (residual <= OUTLYING * usual)
    inverse = _inverse(products[agree].sum(axis=0))
    return Fit(weights, explained, left_over, residual, power, whole, agree, inverse)


def _share(residual: FloatArray, power: FloatArray, where: BoolArray) -> float:
    """Return the share of the power that is left over in the windows ``where``."""
    total = float(np.sum(power[where] ** 2))
    return float(np.sum(residual[where] ** 2)) / total if total > 0 else 1.0


def _solve(products: FloatArray) -> FloatArray:
    """Return the weights of the others, of their ``products``; each is scaled to one size."""
    sizes = np.sqrt(np.maximum(np.diag(products), 1e-30))
    scaled = products / np.outer(sizes, sizes)
    weights, *_ = np.linalg.lstsq(scaled[1:, 1:], scaled[1:, 0], rcond=1e-9)
    return np.asarray(weights * sizes[0] / sizes[1:])


def _inverse(products: FloatArray) -> FloatArray:
    """Return the inverse of the others' part of ``products`` times the series' own product."""
    sizes = np.sqrt(np.maximum(np.diag(products), 1e-30))
    scaled = products / np.outer(sizes, sizes)
    inverse = np.linalg.pinv(scaled[1:, 1:], rcond=1e-9, hermitian=True)
    return np.asarray(inverse * np.outer(sizes[0] / sizes[1:], sizes[0] / sizes[1:]))


def points_of(windows: BoolArray, count: int) -> BoolArray:
    """Return which of ``count`` points lie in ``windows``, shape (w,)."""
    found = np.repeat(windows, round(WINDOW_S / STEP_S))
    return np.append(found, np.zeros(count - found.size, np.bool_))


def shifted(series: FloatArray, steps: int) -> FloatArray:
    """Return ``series`` with the value of ``steps`` later at every point; 0 beyond its ends."""
    found = np.zeros_like(series)
    if steps >= 0:
        found[: series.size - steps] = series[steps:]
    else:
        found[-steps:] = series[: series.size + steps]
    return found
