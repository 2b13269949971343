"""Whether a certification tells a vehicle's line from a profiler's error, on simulated runs.

Run `python tests/benchmarks/bench_certify_wander.py [FIRST [COUNT]]` for the figures of the page on
certification. Every road is driven five times, each time on another line (4.5.2: decimetres between
passes, centimetres within), and compared with the road along the middle line. The same runs are
certified as they are, and with one true error, the four in turn. `FIRST` is the seed of the first
road: what the limits were chosen by had other seeds.
"""

import os
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np

from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.certify.judging.contents import Judged, SectionSheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.sections import Run, section_sheet, truth_of
from floatref_conformance.certify.plan.plan_document import SectionPlan
from floatref_conformance.devices.builtin import process_quietly
from floatref_conformance.proving_ground import Scenario, simulate
from floatref_conformance.proving_ground.scenario import repeat_passes

PASSES = 5
SECTION_M = (70.0, 230.93)
PIPELINES = ("temporal-basic", "road-prior-smoother")
FAULTS = ("distance 1 %", "height 3 %", "skew 10 ms", "wrong path")
LIMITS = CertificationLimits(runs=PASSES)
DRIVE = Scenario(
    length_m=320.0,
    wander_m=0.08,
    wander_within_m=0.03,
    rate_hz=2000.0,
    profile_interval_m=0.0254,
    imu=False,
    gnss=False,
    response=False,
)


def drives_of(seed: int) -> tuple[Scenario, ...]:
    """Return the passes over the road of ``seed``, at a speed and of a roughness of its own."""
    rng = np.random.default_rng(seed)
    speed, roughness = rng.uniform(50.0, 95.0), rng.uniform(1.0, 3.5)
    drive = replace(
        DRIVE, seed=1000 * seed, speed_kmh=round(speed, 1), iri_m_per_km=round(roughness, 2)
    )
    return repeat_passes(drive, PASSES)


def later(recording: Recording, by_s: float) -> Recording:
    """Return ``recording`` with heights that are later, or earlier, than they say."""
    channels = tuple(
        replace(c, clock=UniformClock(c.clock.rate, c.clock.start_s + by_s))
        if c.id.name == "height" and isinstance(c.clock, UniformClock)
        else c
        for c in recording.channels
    )
    return replace(recording, channels=channels)


def stretched(profile: Profile, scale: float) -> Profile:
    """Return what an encoder makes of ``profile`` that counts ``scale`` times the distance."""
    at = profile.distance_m
    # The encoder counts from the place at which the section begins.
    places = SECTION_M[0] + (at - SECTION_M[0]) / scale
    return with_elevation(profile, [np.interp(places, at, t.elevation) for t in profile.tracks])


def with_elevation(profile: Profile, elevation: Sequence[np.ndarray]) -> Profile:
    tracks = (
        ProfileTrack.of(t.name, z, t.valid) for t, z in zip(profile.tracks, elevation, strict=True)
    )
    return replace(profile, tracks=tuple(tracks))


def with_fault(
    name: str, sign: int, recordings: Sequence[Recording], runs: Sequence[Profile], pipeline: str
) -> list[Profile]:
    """Return the runs with the true error ``name``, in the direction of ``sign``."""
    if name == "skew 10 ms":
        return [process_quietly(later(r, 0.01 * sign), pipeline) for r in recordings]
    if name == "distance 1 %":
        return [stretched(run, 1.0 + 0.01 * sign) for run in runs]
    if name == "height 3 %":
        scale = 1.0 + 0.03 * sign
        return [with_elevation(r, [scale * t.elevation for t in r.tracks]) for r in runs]
    # One sensor over both: the other wheel path was not measured.
    path = 0 if sign > 0 else 1
    return [with_elevation(r, [r.tracks[path].elevation] * 2) for r in runs]


def certify(truth: Profile, runs: Sequence[Profile]) -> SectionSheet:
    plan = SectionPlan("main", Path("reference"), (), SECTION_M)
    placed = [Run(f"run-{k}", f"runs/run-{k}", (), run) for k, run in enumerate(runs, 1)]
    return section_sheet(plan, truth_of(plan, truth), placed, LIMITS)


def failed(sheet: SectionSheet) -> set[str]:
    """Return the criteria that fail."""
    return {c.id for c in sheet.criteria if c.judged is Judged.FAIL}


def try_road(seed: int) -> tuple[set[str], str, set[str]]:
    """Return what fails of healthy runs over a road, a fault, and what fails with it."""
    drives, pipeline = drives_of(seed), PIPELINES[seed // 8 % len(PIPELINES)]
    truth = simulate(replace(drives[0], wander_m=0.0, wander_within_m=0.0)).truth
    recordings = [simulate(drive).recording for drive in drives]
    runs = [process_quietly(recording, pipeline) for recording in recordings]
    fault, sign = FAULTS[seed % len(FAULTS)], 1 if seed // 4 % 2 else -1
    wrong = with_fault(fault, sign, recordings, runs, pipeline)
    return failed(certify(truth, runs)), fault, failed(certify(truth, wrong))


def main(first: int = 7000, count: int = 200) -> None:
    false, tried, found, by = 0, Counter[str](), Counter[str](), Counter[str]()
    for seed in range(first, first + count):
        healthy, fault, wrong = try_road(seed)
        false += bool(healthy)
        print(
            f"seed {seed}: healthy fails {sorted(healthy)}, {fault} fails {sorted(wrong)}",
            flush=True,
        )
        tried[fault] += 1
        found[fault] += bool(wrong)
        by.update(f"{fault}: {id_}" for id_ in wrong)
    print(f"healthy: {false} of {count} fail")
    for fault in FAULTS:
        print(f"{fault}: found {found[fault]} of {tried[fault]}")
    for line, times in sorted(by.items()):
        print(f"  {line} in {times}")


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:3]))
