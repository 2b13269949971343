"""A road of Sayers' spectrum and ten repeated runs over it, as profiles, without a simulation."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.judging import sections
from floatref_conformance.certify.judging.contents import SectionSheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.sections import Run, section_sheet, truth_of
from floatref_conformance.certify.plan.plan_document import SectionPlan
from floatref_conformance.proving_ground.roads.random_roads import sayers_road
from floatref_conformance.proving_ground.roads.road import Road

INTERVAL_M = 0.05
LENGTH_M = 200.0
BEFORE_M = 40.0
"""What the drawn road has before the section: its first metres are level."""
NOISE_M = 1e-4
"""Standard deviation of what each run adds to the road, about 0.2 m long."""
FINE_M = 0.005
SECTION_M = 160.9
BEGINS_M = 60.0

RunMaker = Callable[..., Profile]
SheetMaker = Callable[..., SectionSheet]


@pytest.fixture(scope="session")
def drawn_road() -> Road:
    """Two wheel paths of about 3.7 m/km, drawn every 5 mm, with 100 m behind the section."""
    return sayers_road("normal", BEFORE_M + LENGTH_M + 100.0, seed=9)


@pytest.fixture(scope="session")
def run_over(drawn_road: Road) -> RunMaker:
    """Return a function that makes the profile of one run.

    Its numbers: ``start_m`` and ``end_m`` on the section's axis, which starts at 0, the axis of
    the run being the same; ``noise_m``, which ``seed`` draws; ``distance`` and ``height``, factors
    on what the encoder and the height sensor tell; ``interval_m``; and ``tracks``.
    """

    def make(
        seed: int = 0,
        start_m: float = 0.0,
        end_m: float = LENGTH_M,
        noise_m: float = NOISE_M,
        distance: float = 1.0,
        height: float = 1.0,
        interval_m: float = INTERVAL_M,
        tracks: tuple[str, ...] = ("left", "right"),
    ) -> Profile:
        draw = np.random.default_rng(seed)
        count = round((end_m - start_m) * distance / interval_m) + 1
        x = start_m + interval_m * np.arange(count) / distance
        made = [
            ProfileTrack.of(
                name,
                height * drawn_road.at(name, BEFORE_M + x) + noise_m * _noise(draw, x, interval_m),
            )
            for name in tracks
        ]
        return Profile(interval_m, tuple(made), start_m)

    return make


@pytest.fixture(scope="session")
def reference(run_over: RunMaker) -> Profile:
    """The section, 200 m, without any error."""
    return run_over(noise_m=0.0)


@pytest.fixture(scope="session")
def ten_runs(run_over: RunMaker) -> tuple[Profile, ...]:
    """Ten runs over the section that a good profiler would make."""
    return tuple(run_over(seed) for seed in range(1, 11))


@pytest.fixture(scope="session")
def written(
    reference: Profile, ten_runs: tuple[Profile, ...], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """Directory with the profile directories `reference` and `runs/run-1` to `runs/run-10`.

    It belongs to the session: copy from it, write nothing into it.
    """
    folder = tmp_path_factory.mktemp("section")
    write_profile(reference, folder / "reference")
    (folder / "runs").mkdir()
    for number, run in enumerate(ten_runs, 1):
        write_profile(run, folder / "runs" / f"run-{number}")
    return folder


@pytest.fixture(scope="session")
def sheet_of(reference: Profile) -> Iterator[SheetMaker]:
    """Return a function that makes the sheet of runs: profiles, called run-1 and so on, or runs.

    What a run's profile tells of its scales is told once, however many sheets it is in.

    Its options: ``limits``, ``stretch_m``, and another ``reference``.
    """

    def make(
        runs: tuple[Profile | Run, ...],
        limits: CertificationLimits = CertificationLimits(),  # noqa: B008  # It is frozen.
        stretch_m: tuple[float, float] | None = None,
        reference: Profile = reference,
    ) -> SectionSheet:
        placed = [
            run if isinstance(run, Run) else Run(f"run-{k}", f"runs/run-{k}", (), run)
            for k, run in enumerate(runs, 1)
        ]
        plan = SectionPlan("main", Path("reference"), (), stretch_m)
        return section_sheet(plan, truth_of(plan, reference), placed, limits)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sections, "fit", cache(sections.fit))
        patch.setattr(sections, "causes", cache(sections.causes))
        yield make


@pytest.fixture(scope="session")
def without() -> RunMaker:
    """Return a function that takes ``count`` points from a wheel path, or flags them alone."""

    def make(
        profile: Profile, track: str, first: int, count: int, flags_only: bool = False
    ) -> Profile:
        whole = profile.track(track)
        elevation, valid = whole.elevation.copy(), whole.valid.copy()
        valid[first : first + count] = False
        if not flags_only:
            elevation[first : first + count] = np.nan
        changed = ProfileTrack.of(track, elevation, valid)
        return replace(
            profile, tracks=tuple(changed if t.name == track else t for t in profile.tracks)
        )

    return make


def _noise(draw: np.random.Generator, x: np.ndarray, interval_m: float) -> np.ndarray:
    """Return noise of 1 m standard deviation whose neighbours within 0.2 m are alike."""
    white = draw.normal(size=x.size + round(0.2 / interval_m))
    width = round(0.2 / interval_m) + 1
    return np.convolve(white, np.ones(width) / np.sqrt(width), mode="valid")
