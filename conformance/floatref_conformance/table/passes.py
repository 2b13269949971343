"""The passes behind the table: a run driven on a road, and what every pipeline makes of it."""

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from floatref.files import read_profile, write_recording
from floatref.files.scratch import scratch_folder
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.case import record_for
from floatref_conformance.devices import builtin
from floatref_conformance.devices.interface import visible
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.exercise import describe, hold_in_memory
from floatref_conformance.proving_ground.drives.runs import RECORDING_LENGTH_M
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.scenario import Scenario, scenario_of_run
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.staging import road_of
from floatref_conformance.table.published import (
    REFERENCE_IRI_M_PER_KM,
    chapter_of,
    published_table,
)

ROADS = ("sayers-normal", "sayers-asphalt-long-waves", "measured")
"""The roads' kinds in turn; each is scaled to the IRI of the published reference pass."""


SLIP_PERCENT_PER_G = 2.5
"""Slip of the encoder's wheel in chapter 5: the one number that is fitted to print, by the two
cells `FITTED`. Other vehicles of print lose 0.6 to 1.2 m in a stop from 72 km/h (3.3.1.3: 3 to 6 %
per g), and 0.8 m from 48 to 24 km/h (3.3.9: 12 % per g)."""
FITTED = frozenset({("temporal-hpf", "brk_49-23_0.18g_b"), ("temporal-hpf", "brk_72-29_0.39g")})
"""The cells, pipeline and run, to which `SLIP_PERCENT_PER_G` is fitted (print: 0.963 and 0.848);
others are predicted."""
OPTICAL_CHAPTER = 6
"""The chapter whose pipelines take the distance of an optical encoder (6.5), which does not slip;
those of chapter 5, and all that print does not have, take that of the wheel's (5.2)."""
LASER_AHEAD_M = 0.0
"""In print the middle of the line laser is on the axis of its accelerometer (4.2.1); the point
laser, which the chapters with results do not use, is 0.105 m ahead."""


def draw_road(seed: int, index: int) -> Road:
    """Return road number ``index`` of ``seed``, long enough for every run."""
    drawn = draw_seed(seed, "road", index)
    kind = ROADS[index % len(ROADS)]
    scenario = Scenario(seed=drawn, road=kind, iri_m_per_km=REFERENCE_IRI_M_PER_KM)
    return road_of(scenario, RECORDING_LENGTH_M)


def slip_of(pipeline: str) -> float:
    """Return by how many percent per g the encoder slips that ``pipeline`` reads."""
    number = published_table(pipeline)
    optical = number is not None and chapter_of(number) == OPTICAL_CHAPTER
    return 0.0 if optical else SLIP_PERCENT_PER_G


def pass_scenario(
    run: str,
    seed: int,
    place: tuple[int, int],
    vehicle: str,
    capabilities: frozenset[str],
    slip_percent_per_g: float = SLIP_PERCENT_PER_G,
) -> Scenario:
    """Return the scenario of a pass; its sensor errors are those of no other run or pass.

    They follow from ``seed``, ``run`` and ``place``, the number of the road and of the noise,
    so that a table of fewer runs or pipelines holds the same figures.
    """
    drawn = draw_seed(seed, run, *place)
    return scenario_of_run(
        run,
        drawn,
        vehicle=vehicle,
        slip_percent_per_g=slip_percent_per_g,
        laser_ahead_m=LASER_AHEAD_M,
        **record_for(capabilities),
    )


@dataclass(frozen=True, eq=False)
class Driven:
    """What a drive came to.

    Attributes:
        truth: unfiltered elevation along the laser's path against true distance.
        encoder_m: distance in m by the encoder at the points of the truth.
        profiles: what every pipeline makes of the recording.
    """

    truth: Profile
    encoder_m: FloatArray
    profiles: Mapping[str, Profile]


class Processing:
    """Pipelines as devices, each given the channels that it declares."""

    def __init__(self, pipelines: Sequence[str]) -> None:
        """Make the devices; InputError if floatref has no such pipeline."""
        self._devices = {name: builtin.make(name) for name in pipelines}
        self._about = {name: describe(device) for name, device in self._devices.items()}

    @property
    def capabilities(self) -> frozenset[str]:
        """What any of the pipelines needs beside the nominal channels."""
        return frozenset(c for each in self._about.values() for c in each.capabilities)

    def profiles(self, scenario: Scenario, road: Road) -> Mapping[str, Profile]:
        """Return the profile that every pipeline makes of ``scenario`` driven on ``road``.

        Raises SuiteError, naming pipeline and run, for a pipeline that fails.
        """
        return self.drive(scenario, f"run {scenario.manoeuvre}", road).profiles

    def drive(
        self,
        scenario: Scenario,
        name: str,
        road: Road | None = None,
        on_failure: Callable[[str, SuiteError], None] | None = None,
    ) -> Driven:
        """Return the profiles of ``scenario``, called ``name``, on ``road`` or else its own.

        A pipeline that fails is left out and ``on_failure`` is called with its name and error;
        without it, SuiteError, naming pipeline and ``name``, is raised.
        """
        simulation = simulate(scenario, road=road)
        truth, recording = simulation.truth, simulation.recording
        encoder_m = encoder_along_truth(simulation)
        # The motion takes more memory than all that follows.
        del simulation
        kinds = list({each.channels for each in self._about.values()})
        with scratch_folder("passes") as folder:
            for number, channels in enumerate(kinds):
                write_recording(visible(recording, channels), folder / str(number))
            del recording
            given = [folder / str(kinds.index(each.channels)) for each in self._about.values()]
            with ThreadPoolExecutor(os.cpu_count()) as workers:
                made = workers.map(partial(self._try, name), self._about, given)
                found = dict(zip(self._about, made, strict=True))
        return Driven(truth, encoder_m, _keep_profiles(found, on_failure))

    def _try(self, name: str, pipeline: str, given: Path) -> Profile | SuiteError:
        try:
            return self._process(name, pipeline, given)
        except SuiteError as error:
            return error

    def _process(self, name: str, pipeline: str, given: Path) -> Profile:
        target = given.with_name(f"profile-{pipeline}")
        try:
            self._devices[pipeline].run(given / "recording.json", target)
            return hold_in_memory(read_profile(target))
        except Exception as error:
            text = " ".join(str(error).split())
            raise SuiteError(f"pipeline {pipeline}, {name}: {text}") from error


def _keep_profiles(
    found: Mapping[str, Profile | SuiteError],
    on_failure: Callable[[str, SuiteError], None] | None,
) -> Mapping[str, Profile]:
    """Return the profiles of ``found``; see `Processing.drive` for the others."""
    profiles: dict[str, Profile] = {}
    for pipeline, made in found.items():
        if isinstance(made, Profile):
            profiles[pipeline] = made
        elif on_failure is None:
            raise made
        else:
            on_failure(pipeline, made)
    return profiles


def draw_seed(seed: int, name: str, *numbers: int) -> int:
    """Return the seed that belongs to ``name`` and ``numbers``."""
    return int(np.random.SeedSequence([seed, *name.encode(), *numbers]).generate_state(1)[0])


def encoder_along_truth(simulation: Simulation) -> FloatArray:
    """Return the distance in m by the encoder at the points of the truth."""
    truth, motion = simulation.truth, simulation.motion
    encoder = simulation.recording.channel("distance")
    recorded = np.interp(motion.times_s, encoder.times_s, encoder.values)
    points = truth.interval_m * np.arange(truth.tracks[0].elevation.size)
    return np.asarray(np.interp(points, motion.distance, recorded))
