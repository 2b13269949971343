"""How well the road prior and two others for the same sensors do in a case of adversity."""

import sys
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import atan, cos, sin
from typing import Any

import numpy as np
from bench_sigma import RUN_IN_M, within
from road_prior_adversities import Adversity

import floatref
from floatref.measures import cross_correlation, high_pass, iri_trace
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.staging import drive_of, road_of

OURS = "road-prior-smoother"
OTHERS = ("temporal-adaptive-hpf-spatial-backward", "spatial-hpf-timer-distortion-reflection")
HALF_M, MAX_OFFSET_M = 80.45, 1.0
ITERATIONS = 5
"""By which a place on a slope is found from its elevation."""


@dataclass(frozen=True)
class Found:
    """How one wheel path compares with the road.

    Attributes:
        cross_correlation: (2.16), after the IRI filter.
        iri_error_percent: of the IRI over the same stretch.
        within_percent: of the points of the run, the truth is within two sigma; NaN without sigma.
        valid_percent: of the points of the stretch.
    """

    cross_correlation: float
    iri_error_percent: float
    within_percent: float
    valid_percent: float


@dataclass(frozen=True)
class Row:
    """What a pipeline made of a case, by seed and wheel path; none if it refused."""

    kind: str
    severity: str
    pipeline: str
    found: tuple[Found, ...]

    def mean(self, name: str) -> float:
        return float(np.mean([getattr(each, name) for each in self.found]))

    def summary(self) -> dict[str, Any]:
        """Return means and extremes as plain values; no figures if the pipeline refused."""
        row: dict[str, Any] = {n: getattr(self, n) for n in ("kind", "severity", "pipeline")}
        if self.found:
            means = {n: round(self.mean(n), 4) for n in vars(self.found[0])}
            row |= {n: mean for n, mean in means.items() if np.isfinite(mean)}
            row["lowest"] = round(self.lowest, 4)
        return row

    @property
    def lowest(self) -> float:
        """Smallest cross correlation."""
        return min(each.cross_correlation for each in self.found)


def simulated(case: Adversity, seed: int) -> Simulation:
    """Return the run of ``case`` with the road and the errors of ``seed``."""
    scenario = replace(case.scenario, seed=seed)
    road = road_of(scenario, drive_of(scenario).length_m)
    road = case.road(road, scenario) if case.road else road
    made = simulate(scenario, road)
    if scenario.grade_percent:
        made = from_the_lane(made, road, atan(scenario.grade_percent / 100))
    return replace(made, recording=case.change(made)) if case.change else made


def from_the_lane(made: Simulation, road: Road, grade_rad: float) -> Simulation:
    """Return ``made`` with elevations from the lane's plane, which profilers measure from.

    On a hill a body that pitches moves the footprint along the slope: no roughness of the road.
    """
    tracks = {}
    for name, track in made.motion.tracks.items():
        place = made.motion.distance
        for _ in range(ITERATIONS):
            place = (track.road_m - cos(grade_rad) * road.at(name, place)) / sin(grade_rad)
        tracks[name] = replace(track, road_m=road.at(name, place))
    return replace(made, motion=replace(made.motion, tracks=tracks))


def truth(made: Simulation, name: str, points: FloatArray) -> FloatArray:
    """Return the road under the laser ``name`` at ``points`` of the encoder's distance."""
    encoder, motion = made.recording.channel("distance"), made.motion
    counted = np.interp(motion.times_s, encoder.times_s, np.nan_to_num(encoder.values))
    return np.interp(points, counted - counted[0], motion.tracks[name].road_m)


def stretch(made: Simulation, where_m: float, interval_m: float) -> slice:
    """Return the points of a profile within `HALF_M` of ``where_m`` of true distance."""
    counted = made.recording.channel("distance").values
    middle = counted[np.argmax(made.motion.distance >= where_m)] - counted[0]
    return slice(round((middle - HALF_M) / interval_m), round((middle + HALF_M) / interval_m))


def compared(made: Simulation, profile: floatref.Profile, where_m: float) -> list[Found]:
    """Return how each wheel path of ``profile`` compares."""
    interval_m, found = profile.interval_m, []
    inside = stretch(made, where_m, interval_m)
    ends = slice(round(RUN_IN_M / interval_m), -round(RUN_IN_M / interval_m))
    for track in profile.tracks:
        road = truth(made, track.name, interval_m * np.arange(track.elevation.size))
        road = high_pass(road, interval_m)
        expected = iri_trace(road, interval_m)[inside]
        trace = iri_trace(track.elevation, interval_m)[inside]
        agreement = cross_correlation(expected, trace, interval_m, MAX_OFFSET_M)
        error = 100.0 * (np.abs(trace).mean() / np.abs(expected).mean() - 1.0)
        sure = np.nan
        if track.sigma is not None:
            sure = within((track.elevation - road)[ends], track.sigma[ends])
        valid = 100.0 * float(np.mean(track.valid[inside])) if track.valid is not None else 100.0
        found.append(Found(agreement.cross_correlation, float(error), sure, valid))
    return found


def quietly(
    recording: floatref.Recording, pipeline: str, settings: Mapping[str, float]
) -> floatref.Profile:
    """Process without warnings: most faults are reported, as they should be."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        return floatref.process(recording, pipeline, settings)


def measured(case: Adversity, seeds: int, settings: dict[str, float]) -> list[Row]:
    found: dict[str, list[Found]] = {name: [] for name in (OURS, *OTHERS)}
    for seed in range(seeds):
        made = simulated(case, seed)
        for name, each in found.items():
            given = settings if name == OURS else {}
            try:
                each += compared(made, quietly(made.recording, name, given), case.where_m)
            except floatref.InputError as error:
                print(f"{case.kind}, {case.severity}, {name}: {error}", file=sys.stderr)
    return [Row(case.kind, case.severity, name, tuple(each)) for name, each in found.items()]
