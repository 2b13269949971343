"""Every command that works on something, to be killed at a random moment.

A key is that of a list in `attacked_commands`, or names what the command does beside it. The words
have the places of `WRITTEN`, and those of the files that `write_working` makes, so that each
command comes to its end and takes seconds.
"""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
from tests.hostile.attacked_commands import WRITTEN

from floatref import Channel, Profile, ProfileTrack, Recording, UniformClock, process
from floatref import write_profile as write_profile
from floatref import write_recording as write_recording
from floatref_conformance.case_files import document
from floatref_conformance.checks.case import Case
from floatref_conformance.classes import DeviceClass
from floatref_conformance.proving_ground import Scenario, simulate

WORKING = {
    "floatref iri --gis": "iri {profile} --recording {placed} --gis {x}.geojson",
    "floatref roughness --gis": "roughness {profile} --recording {placed} --gis {x}.geojson",
    "floatref allan --settings": "allan {still} --settings {x}",
    "floatref tune --out": "tune {fast} {braked} --reference {road} --settings {given} --out {x}",
    "floatref tune --plot": (
        "tune {fast} {braked} --reference {road} --settings {given} --out {out}.json --plot {x}.png"
    ),
    "floatref vehicle --out": "vehicle {learned} --out {x}",
    "conformance run --report": "run --check quiescent --report {x}",
    "conformance submit --out": "submit --check quiescent --out {x}.zip",
    "conformance export --out": "export --check quiescent --out {x}",
    "conformance certify --report": (
        "certify {run_1} {run_2} --reference {profile} --section 0:150 --report {x}"
    ),
    "conformance table --plot": (
        "table --run const_16 --pipeline temporal-basic --roads 1 --seeds 1 --plot {x}.png"
    ),
    "conformance faults --out": (
        "faults --fault accelerometer-sign --pipeline temporal-basic --drive constant --out {x}"
    ),
}
"""Those of `WRITTEN` that end at once with its files, or take minutes."""
PRINTING = {
    "floatref iri profile": "iri {profile}",
    "floatref roughness profile": "roughness {profile}",
    "floatref straightedge profile": "straightedge {profile}",
    "floatref compare profile": "compare {profile} {run_1}",
    "floatref pipelines recording": "pipelines {run}",
    "floatref channels file": "channels {csv}",
    "floatref allan recording": "allan {still}",
    "floatref warm pipelines": "warm temporal-basic temporal-hpf",
    "conformance run alone": "run --check quiescent",
    "conformance replay case": "replay {case} --device builtin:temporal-basic",
    "conformance certify runs": "certify {run_1} {run_2} --reference {profile} --section 0:150",
    "conformance selftest checks": (
        "selftest --seeds 0 --false-alarms 0 --check quiescent --no-unique"
    ),
    "conformance practices name": "practices",
}
"""Commands that write nothing, or with options that have them write nothing."""
OTHERS = {"floatref batch": "batch {run} {braked} --out {x} --jobs 1"}
"""What is in no list of attacked places."""
NOT_KILLED = {
    "floatref adapters": "prints a list",
    "floatref live": "waits for samples: tests/sdk/cli/live/test_killed_live.py",
    "conformance list": "prints a list",
    "conformance scenario": "prints a list",
    "conformance explain": "prints a text",
    "conformance verify": "needs an archive of minutes: tests/conformance/submission",
}
"""Commands that are not killed here, and why."""
PLACES = {
    "floatref live --out",
    "floatref channels --map",
}
"""Places of `WRITTEN` of which nothing can be written here."""
KILLED = {k: t for k, t in {**WRITTEN, **WORKING, **PRINTING, **OTHERS}.items() if k not in PLACES}


BRAKED = Scenario(
    manoeuvre="stop",
    length_m=160.0,
    event_at_m=90.0,
    tracks=("left",),
    speed_kmh=50.0,
    final_speed_kmh=25.0,
    deceleration_g=0.3,
    dwell_s=1.2,
    vehicle="soft-van",
    rate_hz=1000.0,
    laser_ahead_m=0.0,
)
"""A run that ends in a stop, from which settings can be learned."""


def write_working(folder: Path) -> dict[str, Path]:
    """Write the files that `WORKING` and `PRINTING` name into ``folder``; return their places."""
    for name, recording in (("placed", _placed()), ("still", _still())):
        write_recording(recording, folder / name)
    z = 0.01 * np.sin(np.arange(4000) / 9.0)
    for seed, name in enumerate(("run_1", "run_2")):
        noise = 2e-5 * np.random.default_rng(seed).normal(size=z.size)
        write_profile(Profile(0.05, (ProfileTrack.of("left", z + noise),)), folder / name)
    braked = simulate(BRAKED)
    write_recording(braked.recording, folder / "braked")
    fast = simulate(replace(BRAKED, manoeuvre="constant", speed_kmh=72.0))
    write_recording(fast.recording, folder / "fast")
    write_profile(fast.truth, folder / "road")
    (folder / "given").write_text('{"cutoff_wavelength_m": 30.0}', encoding="ascii")
    learned = process(braked.recording, "road-prior-smoother")
    write_profile(learned, folder / "learned")
    kept = document(Case("stop", Scenario()), DeviceClass.NOMINAL, "builtin:temporal-basic", "x")
    (folder / "case").write_text(json.dumps(kept), encoding="utf-8")
    files = ("learned", "case", "given")
    names = ("placed", "still", "run_1", "run_2", "braked", "fast", "road", *files)
    return {name: folder / name for name in names}


def _placed() -> Recording:
    """Return 200 m with places, on the axis of the profile."""
    clock, count = UniformClock.of(10.0), 101
    along = np.linspace(0.0, 200.0, count)
    return Recording(
        (
            Channel.of("distance", along, clock),
            Channel.of("gnss_latitude", 0.8 + along / 6.4e6, clock),
            Channel.of("gnss_longitude", np.full(count, 0.1), clock),
        )
    )


def _still() -> Recording:
    """Return six minutes at rest, whose noise gives settings."""
    draw, clock, count = np.random.default_rng(0), UniformClock.of(100.0), 36_000
    names = ("roll_rate", "pitch_rate", "yaw_rate")
    channels = [Channel.of(n, 1e-4 * draw.normal(size=count), clock) for n in names]
    force = 9.80665 + 1e-3 * draw.normal(size=count)
    channels.append(Channel.of("vertical_specific_force", force, clock, "left"))
    channels.append(Channel.of("distance", np.zeros(count), clock))
    return Recording(tuple(channels))
