"""Making the table of drawn stops: one drive at a time, so that memory and files stay small."""

from floatref.errors import InputError
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.making import Watch
from floatref_conformance.table.passes import Processing
from floatref_conformance.table.stops.scores import stop_scores
from floatref_conformance.table.stops.settings import StopSettings
from floatref_conformance.table.stops.table import StopTable, WheelPath


def make_stop_table(settings: StopSettings | None = None, watch: Watch | None = None) -> StopTable:
    """Return the table of ``settings``; ``watch`` is told of every drive before it starts.

    Raises SuiteError for a pipeline that fails or leaves out points that count.
    """
    settings = settings or StopSettings()
    watch = watch or (lambda _: None)
    processing = Processing(settings.pipelines)
    paths: list[WheelPath] = []
    for name, scenario in settings.scenarios(processing.capabilities):
        watch(name)
        paths += _driven(processing, name, scenario)
    return StopTable(settings, tuple(paths))


def _driven(processing: Processing, name: str, scenario: Scenario) -> list[WheelPath]:
    """Return every wheel path of one drive through every pipeline."""
    driven = processing.driven(scenario, name)
    paths: list[WheelPath] = []
    for pipeline, profile in driven.profiles.items():
        try:
            scores = stop_scores(driven.truth, driven.told_m, profile)
        except (DeviceError, InputError) as error:
            raise SuiteError(f"pipeline {pipeline}, {name}: {error}") from error
        paths += [WheelPath(pipeline, track, scenario, found) for track, found in scores.items()]
    return paths
