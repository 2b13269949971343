"""The table of drawn stops: made and summed up."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.making import Watch
from floatref_conformance.table.passes import Processing
from floatref_conformance.table.stops.stop_scores import StopScores, stop_scores
from floatref_conformance.table.stops.stop_settings import StopSettings


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
            of each wheel path, as in `StopScores`; None without sigma.
        cross_correlation_encoder_median, cross_correlation_encoder_percentile_1,
            cross_correlation_encoder_lowest: along the encoder's distance; None without.
        nees, nees_true_distance: of the mean NEES of each wheel path; None without sigma.
    """

    wheel_paths: int
    cross_correlation_median: float
    cross_correlation_percentile_1: float
    cross_correlation_lowest: float
    iri_error_median_percent: float
    iri_error_largest_percent: float
    within_two_sigma_percent: Ends | None
    within_two_sigma_true_distance_percent: Ends | None
    cross_correlation_encoder_median: float | None = None
    cross_correlation_encoder_percentile_1: float | None = None
    cross_correlation_encoder_lowest: float | None = None
    nees: Ends | None = None
    nees_true_distance: Ends | None = None


def summary(paths: Sequence[WheelPath]) -> StopSummary:
    """Return the summary of ``paths``; InputError if empty."""
    if not paths:
        raise InputError("no wheel path to sum up; make at least one drive")
    scores = [path.scores for path in paths]
    correlations = [each.cross_correlation for each in scores]
    errors = [abs(each.iri_error_percent) for each in scores]
    beside = [c for each in scores if (c := each.cross_correlation_encoder) is not None]
    return StopSummary(
        len(paths),
        float(np.median(correlations)),
        float(np.percentile(correlations, 1)),
        min(correlations),
        float(np.median(errors)),
        max(errors),
        _ends([each.within_two_sigma_percent for each in scores]),
        _ends([each.within_two_sigma_true_distance_percent for each in scores]),
        float(np.median(beside)) if beside else None,
        float(np.percentile(beside, 1)) if beside else None,
        min(beside) if beside else None,
        _ends([each.nees for each in scores]),
        _ends([each.nees_true_distance for each in scores]),
    )


def _ends(values: Sequence[float | None]) -> Ends | None:
    """Return the ends of the values that are not None; None without such values."""
    known = [value for value in values if value is not None]
    if not known:
        return None
    return Ends(min(known), float(np.median(known)), max(known))


def make_stop_table(settings: StopSettings | None = None, watch: Watch | None = None) -> StopTable:
    """Return the table of ``settings``; ``watch`` is called before every drive.

    Raises SuiteError for a pipeline that fails or leaves out points that count.
    """
    settings = settings or StopSettings()
    watch = watch or (lambda _: None)
    processing = Processing(settings.pipelines)
    paths: list[WheelPath] = []
    for name, scenario in settings.scenarios(processing.capabilities):
        watch(name)
        paths += _drive_all(processing, name, scenario)
    return StopTable(settings, tuple(paths))


def _drive_all(processing: Processing, name: str, scenario: Scenario) -> list[WheelPath]:
    """Return every wheel path of one drive through every pipeline."""
    driven = processing.drive(scenario, name)
    paths: list[WheelPath] = []
    for pipeline, profile in driven.profiles.items():
        try:
            scores = stop_scores(driven.truth, driven.encoder_m, profile)
        except (DeviceError, InputError) as error:
            raise SuiteError(f"pipeline {pipeline}, {name}: {error}") from error
        paths += [WheelPath(pipeline, track, scenario, found) for track, found in scores.items()]
    return paths
