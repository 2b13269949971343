"""Where a piece of the reference lies in a run: every place, direction, scale and wheel path.

The score of a place is Σ p·q / √(Σ p² Σ q²) of slopes, which is their correlation times the root
of the share of the piece that the run covers there.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np
from numpy.fft import irfft, rfft
from numpy.typing import NDArray

from floatref.measures.locating.slopes import STEP_M, Slope
from floatref.values.arrays import FloatArray


class Searched:
    """A run's slopes and, once asked for, their spectra."""

    def __init__(self, slopes: Sequence[Slope]) -> None:
        self.slopes = slopes
        self._spectra: dict[int, list[NDArray[np.complex128]]] = {}

    def spectra(self, padded: int) -> list[NDArray[np.complex128]]:
        """Return the spectra of all wheel paths, padded with zeros to ``padded`` points."""
        if padded not in self._spectra:
            self._spectra[padded] = [rfft(slope.values, padded) for slope in self.slopes]
        return self._spectra[padded]


def score_places(templates: Sequence[FloatArray], searched: Searched) -> list[list[FloatArray]]:
    """Return the score of every template in every wheel path, by place.

    Place k has the template's last point on point k of the run; places run over its end.
    """
    run, size = searched.slopes, templates[0].size
    count = run[0].values.size
    padded = 1 << (count + size - 2).bit_length()
    energies = [_windowed_energy(slope.values, size) for slope in run]
    rows = []
    for template in templates:
        spectrum = rfft(template[::-1], padded)
        own = float(np.square(template).sum())
        rows.append(
            [
                _normalise(irfft(spectrum * s, padded)[: count + size - 1], own * energy)
                for s, energy in zip(searched.spectra(padded), energies, strict=True)
            ]
        )
    return rows


def _windowed_energy(values: FloatArray, size: int) -> FloatArray:
    """Return the sum of squares of the ``size`` points up to every point, and over the end."""
    total = np.concatenate((np.zeros(size), np.cumsum(np.square(values))))
    padded = np.concatenate((total, np.full(size - 1, total[-1])))
    return np.asarray(padded[size:] - padded[: padded.size - size])


def _normalise(products: FloatArray, energies: FloatArray) -> FloatArray:
    """Return ``products`` over the root of ``energies``, 0 where there is next to no energy."""
    least = 1e-6 * float(energies.max(initial=0.0))
    shaped = energies > least
    out = np.zeros(products.size)
    np.divide(products, np.sqrt(np.where(shaped, energies, 1.0)), out=out, where=shaped)
    return out


LARGEST_SCALE = 0.06
"""Largest distance error that is searched."""
DRIFT_M = 0.8
"""Largest drift of a piece from end to end between two scales: half its shortest wave."""
TIE = 0.03
"""Scores that differ by less are equally good."""
APART_M = 2.0
"""Two fits nearer than this are one."""
LEAST_SCORE, SURE_SCORE = 0.4, 0.8
"""Nothing below the first is a fit; above the second nothing else need be tried."""

Pairing = tuple[tuple[int, int], ...]
"""Index of the reference's wheel path and of the run's."""


@dataclass(frozen=True)
class Candidate:
    """A place at which a piece of the reference fits the run.

    ``at_m`` of the piece's middle lies at ``run_m`` of the run, whose distance is ``scale`` times
    as long; ``score`` is below zero for heights upside down. ``needed`` is the score that chance
    reaches among as many places.
    """

    score: float
    at_m: float
    run_m: float
    scale: float
    mirrored: bool
    pairing: Pairing
    needed: float = LEAST_SCORE

    @property
    def found(self) -> bool:
        """Whether chance does not explain the score."""
        return abs(self.score) >= self.needed


@dataclass(frozen=True, eq=False)
class Piece:
    """From and to of a stretch of the reference, and its slopes by wheel path."""

    start_m: float
    end_m: float
    slopes: tuple[Slope, ...]

    @property
    def middle_m(self) -> float:
        """Its middle."""
        return 0.5 * (self.start_m + self.end_m)

    def template(self, track: int, scale: float, mirrored: bool) -> FloatArray:
        """Return its slope as a run of ``scale`` would take it, at every step."""
        slope = self.slopes[track]
        count = max(int((self.end_m - self.start_m) * scale / STEP_M) + 1, 2)
        steps = (np.arange(count) - 0.5 * (count - 1)) * STEP_M / scale
        places = self.middle_m + steps
        values = np.interp(places, slope.distance_m, slope.values, 0.0, 0.0)
        return np.asarray(-values[::-1] if mirrored else values)


def search(
    piece: Piece,
    run: Sequence[Slope],
    scales: Sequence[float],
    mirrors: Sequence[bool],
    expected_m: float,
) -> list[Candidate]:
    """Return the fits of ``piece`` in ``run`` that are equally good, the preferred one first.

    Preferred are heights not upside down, then no mirroring, then wheel paths in their order,
    then the place nearest to ``expected_m``.
    """
    searched = Searched(run)
    found = [c for scale in scales for c in _at_scale(piece, searched, scale, mirrors)]
    if not found:
        return []
    best = max(abs(c.score) for c in found)
    equal = [c for c in found if abs(c.score) >= best - TIE]
    first = min(equal, key=lambda c: _strangeness(c, expected_m, best))
    return [first, *(c for c in equal if c is not first)]


def scales_of(length_m: float, largest: float = LARGEST_SCALE) -> list[float]:
    """Return the scales to try for a piece, from one outwards."""
    step = DRIFT_M / max(length_m, 10.0)
    count = math.ceil(largest / step)
    return [1.0 + step * n for n in sorted(range(-count, count + 1), key=abs)]


def chance(piece: Piece, lengths: Sequence[float], tries: int) -> float:
    """Return the score that chance reaches among ``tries`` per length of a step, as often."""
    width = min(_spread(s.values) for s in piece.slopes)
    places = max(sum(lengths) / APART_M, 1.0) * tries
    return min(max(1.25 * math.sqrt(2.0 * math.log(places)) * width, LEAST_SCORE), 0.85)


def _spread(values: FloatArray) -> float:
    """Return the 1-sigma of the score of two unlike roads of such a spectrum."""
    power = np.square(np.abs(rfft(values, 2 * values.size)))
    acf = irfft(power)
    if acf[0] <= 0:
        return 1.0
    return float(np.sqrt(np.square(acf / acf[0]).sum() / values.size))


def _strangeness(c: Candidate, expected_m: float, best: float) -> tuple[bool, bool, bool, float]:
    """Return by what one of equal candidates is preferred to another, the least first."""
    ordered = all(i == j for i, j in c.pairing)
    # A neighbouring scale is no other place: among those the score decides.
    away = abs(c.run_m - expected_m) // APART_M
    return c.score < 0, c.mirrored, not ordered, away + (best - abs(c.score)) / TIE


def _at_scale(
    piece: Piece, searched: Searched, scale: float, mirrors: Sequence[bool]
) -> Iterator[Candidate]:
    """Yield the best places of every direction and pairing at one scale."""
    run, start = searched.slopes, searched.slopes[0].start_m
    for mirrored in mirrors:
        templates = [piece.template(i, scale, mirrored) for i in range(len(piece.slopes))]
        size = templates[0].size
        scores = score_places(templates, searched)
        for pairing in pairings(len(templates), len(run)):
            mean = _joint(scores, run, pairing)
            for index in _peaks(mean):
                middle = start + STEP_M * (index - (size - 1) + 0.5 * (size - 1))
                yield Candidate(
                    float(mean[index]), piece.middle_m, middle, scale, mirrored, pairing
                )


def _joint(
    scores: Sequence[Sequence[FloatArray]], run: Sequence[Slope], pairing: Pairing
) -> FloatArray:
    """Return the mean score of ``pairing`` by place; wheel paths without a shape do not count."""
    alive = [scores[i][j] for i, j in pairing if run[j].measured.any()]
    return np.asarray(sum(alive) / len(alive) if alive else np.zeros(scores[0][0].size))


def pairings(count: int, of_run: int) -> list[Pairing]:
    """Return every way to pair ``count`` wheel paths with those of a run, in order first."""
    if count <= of_run:
        return [tuple(enumerate(order)) for order in permutations(range(of_run), count)]
    return [
        tuple((i, j) for j, i in enumerate(order)) for order in permutations(range(count), of_run)
    ]


def _peaks(mean: FloatArray) -> list[int]:
    """Return the places of the local extremes that are as good as the best, of either sign."""
    size = np.abs(mean)
    best = float(size.max(initial=0.0))
    if best <= 0:
        return []
    inner = np.concatenate(([0.0], size, [0.0]))
    top = (size >= best - TIE) & (size >= inner[:-2]) & (size >= inner[2:])
    places = np.flatnonzero(top)
    return [int(p) for p in places[:200]]
