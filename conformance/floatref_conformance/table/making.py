"""Making the table, road by road, noise by noise, run by run, and how far it is."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.proving_ground.drives.runs import REFERENCE_RUN
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.table.cells import Cell, ComparisonTable
from floatref_conformance.table.passes import (
    Driven,
    Processing,
    draw_road,
    pass_scenario,
    slip_of,
)
from floatref_conformance.table.published import published_figures
from floatref_conformance.table.scores import Scores, score
from floatref_conformance.table.table_settings import TableSettings

REFERENCE_PIPELINE = "temporal-basic"
"""What the reference pass is processed by, as in the dissertation."""

Watch = Callable[[str], None]
"""Called with the name of every pass before it is driven."""
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
        road = draw_road(settings.seed, road_number)
        for noise in range(settings.seeds):
            for pipeline, run, tracks in _score_set(settings, road, (road_number, noise), watch):
                scores[pipeline, run].extend(tracks)
    figures = published_figures()
    cells = (Cell(*key, tuple(passes), figures.get(key)) for key, passes in scores.items())
    return ComparisonTable(settings, tuple(cells))


def _score_set(
    settings: TableSettings, road: Road, place: tuple[int, int], watch: Watch
) -> Iterator[PipelineScores]:
    """Yield the scores of one set of passes; ``place`` is the number of its road and noise."""
    where = f"road {place[0] + 1}, noise {place[1] + 1}"
    watch(f"{where}: {REFERENCE_RUN}")
    (reference,) = _drive(settings, road, place, REFERENCE_RUN, (REFERENCE_PIPELINE,))
    for run in settings.runs:
        watch(f"{where}: {run}")
        for driven in _drive(settings, road, place, run, settings.pipelines):
            references = _references(reference, driven)
            for pipeline, profile in driven.profiles.items():
                yield pipeline, run, _scores(references, profile, pipeline, run)


def _drive(
    settings: TableSettings,
    road: Road,
    place: tuple[int, int],
    run: str,
    pipelines: tuple[str, ...],
) -> Iterator[Driven]:
    """Yield one pass with the profile of every pipeline, once for each encoder that they read."""
    for slip in dict.fromkeys(map(slip_of, pipelines)):
        processing = Processing([name for name in pipelines if slip_of(name) == slip])
        scenario = pass_scenario(
            run, settings.seed, place, settings.vehicle, processing.capabilities, slip
        )
        yield processing.drive(scenario, f"run {run}", road)


def _references(reference: Driven, driven: Driven) -> tuple[Profile, Profile]:
    """Return the profile of the reference pass as it is, and along the encoder of ``driven``."""
    profile = reference.profiles[REFERENCE_PIPELINE]
    true_m = driven.truth.interval_m * np.arange(driven.encoder_m.size)
    places = np.interp(profile.distance_m, driven.encoder_m, true_m)
    counted = np.interp(places, true_m, reference.encoder_m)
    tracks = (
        ProfileTrack.of(t.name, np.interp(counted, profile.distance_m, t.elevation))
        for t in profile.tracks
    )
    return profile, replace(profile, tracks=tuple(tracks))


def _scores(
    references: tuple[Profile, Profile], profile: Profile, pipeline: str, run: str
) -> tuple[Scores, ...]:
    try:
        found, beside = (score(reference, profile) for reference in references)
    except (DeviceError, InputError) as error:
        raise SuiteError(f"pipeline {pipeline}, run {run}: {error}") from error
    return tuple(
        replace(scores, cross_correlation_encoder=beside[name].cross_correlation)
        for name, scores in found.items()
    )


class PassProgress:
    """A bar on a terminal, else one line for each set of passes; a context manager.

    Call it with the name of every pass before it is driven.
    """

    def __init__(self, total: int, console: Console | None = None) -> None:
        """Expect ``total`` passes; write to ``console``, or else to standard error."""
        self._console = console or Console(stderr=True, emoji=False)
        self._bar = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            TextColumn("{task.completed:.0f} of {task.total:.0f}"),
            TimeElapsedColumn(),
            console=self._console,
            transient=True,
            disable=not self._console.is_terminal,
        )
        self._task = self._bar.add_task("", total=total)
        self._started = 0
        self._set = ""

    def __enter__(self) -> "PassProgress":
        """Show the bar."""
        self._bar.start()
        return self

    def __exit__(self, *raised: object) -> None:
        """Take the bar away, also after an error."""
        self._bar.stop()

    def __call__(self, name: str) -> None:
        """Show that the pass ``name`` ("set: run") starts and those before are done."""
        self._bar.update(self._task, description=name, completed=self._started)
        self._started += 1
        group = name.partition(":")[0]
        if group != self._set and not self._console.is_terminal:
            self._console.print(f"{group} …", markup=False, highlight=False, soft_wrap=True)
        self._set = group
