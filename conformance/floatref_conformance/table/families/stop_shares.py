"""Many stops through a pipeline: how often it is right, what it flags, and what its sigma holds.

Everything is along the encoder's distance, the profile's own, over all points of the scored 160.9
m. Each wheel path is one of four kinds, so that their shares add up to 100 %:

- *right and valid*: the IRI of all points is right, and at most `FLAGGED_M` are flagged where the
  vehicle is faster than 16 km/h. This is what a user wants.
- *right and flagged*: the IRI of all points is right, and more than that is flagged: flags that
  were not needed.
- *wrong and flagged*: the IRI of all points is wrong, but not that of the road's own shape in place
  of flagged points: the flags cover what is wrong. A path without any profile is of this kind, as a
  refusal leaves no point valid.
- *wrong and valid*: the IRI stays wrong with the road's own shape in place of flagged points. A
  user who leaves out what is flagged is misled; this goes first, whatever the IRI of all points is.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES
from floatref_conformance.table.families.conditions import Condition
from floatref_conformance.table.families.family_scores import FamilyScores, PathScores
from floatref_conformance.table.families.family_table import FamilyPath, FamilyTable

FLAGGED_M = 1.0
"""Flagged length in m of points at 16 km/h or more with which a wheel path is still valid. By an
encoder that slips by 12 % per g, the most that a family draws, 16 km/h lie beside their place by
0.12 v²/g = 0.24 m before a stop and after it, whatever the brake; as much again is for edges."""
HELD_PERCENT = (85.0, 99.5)
"""A sigma is calibrated that contains this share of the points within two of it. By a normal error
they were 95.4 %; over 160.9 m a slow error has few independent points, so that it may be less."""


class Kind(Enum):
    """What a wheel path is, see above."""

    RIGHT_VALID = "right and valid"
    RIGHT_FLAGGED = "right and flagged"
    WRONG_FLAGGED = "wrong and flagged"
    WRONG_VALID = "wrong and valid"


@dataclass(frozen=True)
class SigmaShares:
    """How much lies within two sigma, of the wheel paths that have a sigma.

    Attributes:
        pooled_percent: of all points of all wheel paths, those within two sigma.
        held_percent: of the wheel paths, those whose own share of points is within `HELD_PERCENT`.
        at_least_percent: those whose own share is its lower end or more.
        percentile_10_percent, median_percent: quantiles of the wheel paths' own shares.
    """

    pooled_percent: float
    held_percent: float
    at_least_percent: float
    percentile_10_percent: float
    median_percent: float


@dataclass(frozen=True)
class StopShares:
    """The wheel paths of some drives together.

    Attributes:
        right_valid_percent, right_flagged_percent, wrong_flagged_percent, wrong_valid_percent: the
            shares of the four kinds; they add up to 100.
        flagged_fast_median_m, flagged_fast_percentile_95_m: flagged length of a wheel path where
            the true speed is 16 km/h or more, of those with a profile; a drive of the family
            `stops` has one event. None without any profile.
        sigma: None without any sigma.
    """

    right_valid_percent: float
    right_flagged_percent: float
    wrong_flagged_percent: float
    wrong_valid_percent: float
    flagged_fast_median_m: float | None
    flagged_fast_percentile_95_m: float | None
    sigma: SigmaShares | None


def kind_of(scores: FamilyScores | None) -> Kind:
    """Return the kind of a wheel path; ``scores`` is None without a profile."""
    if scores is None:
        return Kind.WRONG_FLAGGED
    if not scores.encoder.valid_is_right:
        return Kind.WRONG_VALID
    if not scores.encoder.all_is_right:
        return Kind.WRONG_FLAGGED
    return Kind.RIGHT_VALID if scores.flagged_fast_m <= FLAGGED_M else Kind.RIGHT_FLAGGED


def share_stops(paths: Sequence[FamilyPath]) -> StopShares:
    """Return the shares of ``paths``, of which there is one at least."""
    kinds = Counter(kind_of(path.scores) for path in paths)
    scores = [path.scores for path in paths if path.scores is not None]
    flagged = [each.flagged_fast_m for each in scores]
    share = {kind: 100.0 * kinds[kind] / len(paths) for kind in Kind}
    return StopShares(
        share[Kind.RIGHT_VALID],
        share[Kind.RIGHT_FLAGGED],
        share[Kind.WRONG_FLAGGED],
        share[Kind.WRONG_VALID],
        float(np.median(flagged)) if flagged else None,
        float(np.percentile(flagged, 95)) if flagged else None,
        _share_sigma([each.encoder for each in scores]),
    )


def _share_sigma(scores: Sequence[PathScores]) -> SigmaShares | None:
    held = [(s, e.sigma_points) for e in scores if (s := e.within_two_sigma_percent) is not None]
    if not held:
        return None
    shares = np.array([share for share, _ in held])
    least, most = HELD_PERCENT
    return SigmaShares(
        float(np.average(shares, weights=[points for _, points in held])),
        100.0 * float(np.mean((shares >= least) & (shares <= most))),
        100.0 * float(np.mean(shares >= least)),
        float(np.percentile(shares, 10)),
        float(np.median(shares)),
    )


def rows_of_stops(
    table: FamilyTable, pipeline: str
) -> Iterator[tuple[Condition, str | None, list[FamilyPath]]]:
    """Yield the wheel paths of each condition, and below it of each vehicle that drove it.

    The vehicle is None where all are together. Conditions without a drive are left out.
    """
    for condition in table.settings.conditions:
        paths = table.of(pipeline, condition)
        for vehicle in (None, *VEHICLES):
            of_it = [p for p in paths if vehicle in (None, p.scenario.vehicle)]
            if of_it:
                yield condition, vehicle, of_it
