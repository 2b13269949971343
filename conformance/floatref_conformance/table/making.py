"""Making the table: road by road, noise by noise, run by run, so that memory stays small."""

from collections.abc import Callable, Iterator, Mapping

from floatref.errors import InputError
from floatref.values.profile import Profile
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.proving_ground.road import Road
from floatref_conformance.proving_ground.runs import REFERENCE_RUN
from floatref_conformance.table.cells import Cell, ComparisonTable
from floatref_conformance.table.passes import Processing, pass_scenario, road_drawn
from floatref_conformance.table.published import published_figures
from floatref_conformance.table.scores import Scores, score
from floatref_conformance.table.settings import TableSettings

REFERENCE_PIPELINE = "temporal-basic"
"""What the reference pass is processed by, as in the dissertation."""

Watch = Callable[[str], None]
"""Told of every pass before it is driven."""
PipelineScores = tuple[str, str, tuple[Scores, ...]]
"""Pipeline, run, and the scores of each wheel path of one pass."""


def make_table(
    settings: TableSettings | None = None, watch: Watch | None = None
) -> ComparisonTable:
    """Return the table of ``settings``, averaged over roads, sensor errors and wheel paths.

    Every set of passes has a reference pass of its own on the same road with other sensor
    errors, through `REFERENCE_PIPELINE`. ``watch`` is called `TableSettings.passes` times.
    Raises SuiteError for a pipeline that fails or leaves out points that count.
    """
    settings = settings or TableSettings()
    watch = watch or (lambda _: None)
    scores: dict[tuple[str, str], list[Scores]] = {
        (pipeline, run): [] for pipeline in settings.pipelines for run in settings.runs
    }
    for road_number in range(settings.roads):
        road = road_drawn(settings.seed, road_number)
        for noise in range(settings.seeds):
            for pipeline, run, tracks in _scored_set(settings, road, (road_number, noise), watch):
                scores[pipeline, run].extend(tracks)
    figures = published_figures()
    cells = (Cell(*key, tuple(passes), figures.get(key)) for key, passes in scores.items())
    return ComparisonTable(settings, tuple(cells))


def _scored_set(
    settings: TableSettings, road: Road, place: tuple[int, int], watch: Watch
) -> Iterator[PipelineScores]:
    """Yield the scores of one set of passes; ``place`` is the number of its road and noise."""
    where = f"road {place[0] + 1}, noise {place[1] + 1}"
    watch(f"{where}: {REFERENCE_RUN}")
    reference = _driven(settings, road, place, REFERENCE_RUN, (REFERENCE_PIPELINE,))
    for run in settings.runs:
        watch(f"{where}: {run}")
        profiles = _driven(settings, road, place, run, settings.pipelines)
        for pipeline, profile in profiles.items():
            yield pipeline, run, _scores(reference[REFERENCE_PIPELINE], profile, pipeline, run)


def _driven(
    settings: TableSettings,
    road: Road,
    place: tuple[int, int],
    run: str,
    pipelines: tuple[str, ...],
) -> Mapping[str, Profile]:
    """Return the profile of every pipeline after one pass."""
    processing = Processing(pipelines)
    scenario = pass_scenario(run, settings.seed, place, settings.vehicle, processing.capabilities)
    return processing.profiles(scenario, road)


def _scores(reference: Profile, profile: Profile, pipeline: str, run: str) -> tuple[Scores, ...]:
    try:
        return tuple(score(reference, profile).values())
    except (DeviceError, InputError) as error:
        raise SuiteError(f"pipeline {pipeline}, run {run}: {error}") from error
