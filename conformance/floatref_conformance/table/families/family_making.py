"""Making the table of families: drive by drive, in one process or several."""

from collections.abc import Mapping
from functools import cache, partial

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.families.conditions import Condition
from floatref_conformance.table.families.family_scores import FamilyScores, family_scores
from floatref_conformance.table.families.family_settings import FamilySettings
from floatref_conformance.table.families.family_table import FamilyPath, FamilyTable
from floatref_conformance.table.making import Watch
from floatref_conformance.table.passes import Processing
from floatref_conformance.worker_pool import map_in_order

Scored = Mapping[str, FamilyScores] | str
"""The scores of one pipeline on one drive by wheel path, or the reason why there are no scores."""


def make_family_table(
    settings: FamilySettings | None = None, watch: Watch | None = None
) -> FamilyTable:
    """Return the table of ``settings``; ``watch`` is called before the result of every drive.

    A pipeline that fails on a drive, or delivers no profile that can be compared, is kept as such.
    The figures do not depend on the number of processes.
    """
    settings = settings or FamilySettings()
    watch = watch or (lambda _: None)
    table = FamilyTable(settings)
    drives = list(settings.scenarios(_processing(settings.pipelines).capabilities))
    # Conditions stay here, as they draw by lambdas, which no other process can be given.
    named = zip(*((name, scenario) for _, name, scenario in drives), strict=True)
    score_one = partial(score_drive, settings.pipelines)
    with map_in_order(score_one, settings.jobs, *named) as results:
        for condition, name, scenario in drives:
            watch(name)
            for pipeline, scored in next(results).items():
                table.paths += wheel_paths(pipeline, condition, scenario, scored)
    return table


def score_drive(pipelines: tuple[str, ...], name: str, scenario: Scenario) -> Mapping[str, Scored]:
    """Simulate ``scenario``, called ``name``, and return the scores of every pipeline."""
    failures: dict[str, SuiteError] = {}
    driven = _processing(pipelines).drive(scenario, name, on_failure=failures.__setitem__)
    return {
        pipeline: str(failures[pipeline])
        if pipeline in failures
        else score_profile(scenario, driven.truth, driven.encoder_m, driven.profiles[pipeline])
        for pipeline in pipelines
    }


def score_profile(
    scenario: Scenario, truth: Profile, encoder_m: FloatArray, profile: Profile
) -> Scored:
    """Return `family_scores`, or the reason why ``profile`` cannot be compared."""
    try:
        return family_scores(scenario, truth, encoder_m, profile)
    except (DeviceError, InputError) as error:
        return str(error)


def wheel_paths(
    pipeline: str, condition: Condition, scenario: Scenario, scored: Scored
) -> list[FamilyPath]:
    """Return the wheel paths of one pipeline on one drive, as a table has them."""
    if isinstance(scored, str):
        return [
            FamilyPath(pipeline, condition, track, scenario, None, scored)
            for track in scenario.tracks
        ]
    return [
        FamilyPath(pipeline, condition, track, scenario, scores) for track, scores in scored.items()
    ]


@cache
def _processing(pipelines: tuple[str, ...]) -> Processing:
    """Return the devices of ``pipelines``, made once in each process."""
    return Processing(pipelines)
