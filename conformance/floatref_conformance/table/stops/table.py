"""The finished table of drawn stops, and what its wheel paths have in common."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.stops.scores import StopScores
from floatref_conformance.table.stops.settings import StopSettings


@dataclass(frozen=True)
class WheelPath:
    """One wheel path of one drive through one pipeline.

    Attributes:
        pipeline: its name.
        track: name of the wheel path.
        scenario: the drive; `conformance simulate` makes it again.
        scores: what came out.
    """

    pipeline: str
    track: str
    scenario: Scenario
    scores: StopScores


@dataclass(frozen=True)
class StopTable:
    """All wheel paths, drive by drive, and the settings that made them."""

    settings: StopSettings
    paths: tuple[WheelPath, ...]

    def of(
        self, pipeline: str, vehicle: str | None = None, road: str | None = None
    ) -> tuple[WheelPath, ...]:
        """Return the wheel paths of ``pipeline``, of one vehicle or kind of road if given."""
        return tuple(
            path
            for path in self.paths
            if path.pipeline == pipeline
            and vehicle in (None, path.scenario.vehicle)
            and road in (None, path.scenario.road)
        )

    def lowest(self, pipeline: str) -> WheelPath:
        """Return the wheel path of ``pipeline`` with the lowest cross correlation."""
        return min(self.of(pipeline), key=lambda path: path.scores.cross_correlation)


@dataclass(frozen=True)
class Ends:
    """The lowest, the median and the highest of several values."""

    lowest: float
    median: float
    highest: float


@dataclass(frozen=True)
class StopSummary:
    """How wheel paths score together.

    Attributes:
        wheel_paths: how many they are.
        cross_correlation_median, cross_correlation_percentile_1, cross_correlation_lowest: of
            the cross correlations with the truth. The first percentile lies linearly between
            the two values next to it.
        iri_error_median_percent, iri_error_largest_percent: of the magnitudes of the errors.
        within_two_sigma_percent, within_two_sigma_true_distance_percent: of the shares of points
            of each wheel path, as in `StopScores`; None where no sigma is told.
    """

    wheel_paths: int
    cross_correlation_median: float
    cross_correlation_percentile_1: float
    cross_correlation_lowest: float
    iri_error_median_percent: float
    iri_error_largest_percent: float
    within_two_sigma_percent: Ends | None
    within_two_sigma_true_distance_percent: Ends | None


def summary(paths: Sequence[WheelPath]) -> StopSummary:
    """Return the summary of ``paths``; InputError for none."""
    if not paths:
        raise InputError("no wheel path to sum up; make at least one drive")
    scores = [path.scores for path in paths]
    correlations = [each.cross_correlation for each in scores]
    errors = [abs(each.iri_error_percent) for each in scores]
    return StopSummary(
        len(paths),
        float(np.median(correlations)),
        float(np.percentile(correlations, 1)),
        min(correlations),
        float(np.median(errors)),
        max(errors),
        _ends([each.within_two_sigma_percent for each in scores]),
        _ends([each.within_two_sigma_true_distance_percent for each in scores]),
    )


def _ends(values: Sequence[float | None]) -> Ends | None:
    """Return the ends of the values that there are; None for none."""
    told = [value for value in values if value is not None]
    if not told:
        return None
    return Ends(min(told), float(np.median(told)), max(told))
