"""The table of families, and how it is summed up by pipeline and condition."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from floatref.errors import InputError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.families.conditions import Condition
from floatref_conformance.table.families.family_scores import FamilyScores, PathScores
from floatref_conformance.table.families.family_settings import FamilySettings


@dataclass(frozen=True)
class FamilyPath:
    """One wheel path of one drive through one pipeline; ``scores`` is None without a profile."""

    pipeline: str
    condition: Condition
    track: str
    scenario: Scenario
    scores: FamilyScores | None
    failure: str = ""


@dataclass(frozen=True)
class AxisSummary:
    """Quantiles along one axis.

    Attributes:
        cross_correlation_median, cross_correlation_percentile_10, cross_correlation_percentile_1,
            cross_correlation_lowest: of the wheel paths. A path without a profile counts as 0.
        iri_error_median_percent, iri_error_percentile_90_percent: of the magnitudes; None without
            any profile.
        within_two_sigma_median_percent: None without sigma.
        right_percent: of the wheel paths, those whose valid points are right.
        nees_median: of the mean NEES of the wheel paths; None without sigma.
    """

    cross_correlation_median: float
    cross_correlation_percentile_10: float
    cross_correlation_percentile_1: float
    cross_correlation_lowest: float
    iri_error_median_percent: float | None
    iri_error_percentile_90_percent: float | None
    within_two_sigma_median_percent: float | None
    right_percent: float
    nees_median: float | None = None


@dataclass(frozen=True)
class FamilySummary:
    """How the wheel paths of a pipeline under some conditions score together."""

    wheel_paths: int
    without_profile: int
    flagged_median_m: float | None
    true: AxisSummary
    encoder: AxisSummary


@dataclass
class FamilyTable:
    """All wheel paths, drive by drive, and the settings that made them."""

    settings: FamilySettings
    paths: list[FamilyPath] = field(default_factory=list)

    def of(self, pipeline: str, condition: Condition | None = None) -> list[FamilyPath]:
        """Return the wheel paths of ``pipeline``, of one condition if given."""
        return [
            path
            for path in self.paths
            if path.pipeline == pipeline and condition in (None, path.condition)
        ]

    def wrong(self) -> list[FamilyPath]:
        """Return, for each pipeline and condition, the worst path whose valid points are wrong.

        They count as wrong if they are so along both axes: slip alone makes nothing wrong. A path
        without a profile is not wrong.
        """
        found: dict[tuple[str, Condition], FamilyPath] = {}
        worst: dict[tuple[str, Condition], float] = {}
        for path in self.paths:
            key, error = (path.pipeline, path.condition), error_of_valid(path)
            if error is not None and error > worst.get(key, 0.0):
                found[key], worst[key] = path, error
        return list(found.values())


def error_of_valid(path: FamilyPath) -> float | None:
    """Return by how much percent the IRI of valid points is wrong; None if they are right."""
    scores = path.scores
    if scores is None or scores.true.valid_is_right or scores.encoder.valid_is_right:
        return None
    return min(scores.true.valid_error_percent, scores.encoder.valid_error_percent)


def summarize(paths: Sequence[FamilyPath]) -> FamilySummary:
    """Return the summary of ``paths``; InputError if empty."""
    if not paths:
        raise InputError("no wheel path to sum up; make at least one drive")
    scores = [path.scores for path in paths if path.scores is not None]
    lacking = len(paths) - len(scores)
    return FamilySummary(
        len(paths),
        lacking,
        _median([each.flagged_m for each in scores]),
        _summarize_axis([each.true for each in scores], lacking),
        _summarize_axis([each.encoder for each in scores], lacking),
    )


def _summarize_axis(scores: Sequence[PathScores], lacking: int) -> AxisSummary:
    correlations = [*(each.cross_correlation for each in scores), *[0.0] * lacking]
    errors = [each.iri_error_percent for each in scores]
    shares = [s for each in scores if (s := each.within_two_sigma_percent) is not None]
    return AxisSummary(
        float(np.median(correlations)),
        float(np.percentile(correlations, 10)),
        float(np.percentile(correlations, 1)),
        min(correlations),
        _median(errors),
        float(np.percentile(errors, 90)) if errors else None,
        _median(shares),
        100.0 * sum(each.valid_is_right for each in scores) / len(correlations),
        _median([n for each in scores if (n := each.nees) is not None]),
    )


def _median(values: Sequence[float]) -> float | None:
    return float(np.median(values)) if values else None
