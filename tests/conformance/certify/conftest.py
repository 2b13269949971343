"""A road of Sayers' spectrum and ten repeated runs over it, as profiles, without a simulation."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_profile
from floatref.measures import high_pass
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


@dataclass(frozen=True)
class WhiteRoad:
    """Elevation of two wheel paths every `FINE_M`, the section `BEGINS_M` from its beginning."""

    left: np.ndarray
    right: np.ndarray

    def reference(self, interval_m=0.025, length_m=SECTION_M):
        """The section as surveyed: unfiltered, with its hills."""
        at = np.arange(0.0, length_m, interval_m)
        hills = 100.0 + 3.0 * np.sin(at / 150.0)
        return self._profile(BEGINS_M + at, interval_m, 0.0, lambda z: z + hills)

    def run(
        self,
        start_m=0.0,
        length_m=SECTION_M + 1.0,
        interval_m=0.04,
        scale=1.0,
        gain=1.0,
        noise=0.0,
        seed=0,
    ):
        """A run from ``start_m`` of the section on, starting at 0: high-passed, with errors.

        ``noise`` is that of slope, in its share of the road's.
        """
        rng = np.random.default_rng(seed)
        at = np.arange(0.0, length_m * scale, interval_m) / scale

        def measured(z):
            slopes = rng.standard_normal(z.size) * noise * 1e-3 / np.sqrt(interval_m)
            return high_pass(gain * (z + np.cumsum(slopes) * interval_m), interval_m)

        return self._profile(BEGINS_M + start_m + at, interval_m, 0.0, measured)

    def _profile(self, at, interval_m, start_m, measured):
        fine = FINE_M * np.arange(self.left.size)
        tracks = tuple(
            ProfileTrack.of(name, measured(np.interp(at, fine, z)))
            for name, z in (("left", self.left), ("right", self.right))
        )
        return Profile(interval_m, tracks, start_m)


def road_of(seed, length_m=700.0):
    """Return a road of white slope, 1e-3 per root of wave number, but for waves below 0.5 m."""
    rng = np.random.default_rng(seed)
    count = int(length_m / FINE_M)
    wave_number = np.fft.rfftfreq(count, FINE_M)
    smoothing = 1.0 / (1.0 + np.square(0.3 * wave_number))
    slopes = rng.standard_normal((2, count)) * 1e-3 / np.sqrt(FINE_M)
    slopes = np.fft.irfft(np.fft.rfft(slopes) * smoothing, count)
    return WhiteRoad(*(np.cumsum(slopes, axis=1) * FINE_M))


def with_tracks(profile, change):
    """Return ``profile`` with the name and elevation of every track as ``change`` gives them."""
    tracks = [change(t.name, t.elevation) for t in profile.tracks]
    return replace(profile, tracks=tuple(ProfileTrack.of(*t) for t in tracks))


@pytest.fixture(scope="package")
def road():
    return road_of(7)


@pytest.fixture(scope="package")
def roads():
    return road_of


@pytest.fixture(scope="package")
def changed():
    return with_tracks
