"""Sample of a certification: a reference, ten runs over it, both parked tests, and the plan."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from floatref.files import write_profile, write_recording
from floatref_conformance.proving_ground.scenario import Scenario, repeat_passes
from floatref_conformance.proving_ground.simulate import simulate

RUNS = 10
SPEEDS_KMH = (64.0, 72.0, 80.0)
FROM_M, TO_M = 70.0, 230.93
"""A tenth of a mile, with 60 m or more before and behind it."""
KNOWN_M = 1609.344
READINGS = 3
ENCODER_PERCENT = 0.03
"""Standard deviation of the encoder's readings of the known path."""
PASS = Scenario(
    length_m=300.0,
    iri_m_per_km=1.6,
    wander_m=0.03,
    rate_hz=4000.0,
    imu=False,
    gnss=False,
    response=False,
)
PARKED = Scenario(imu=False, gnss=False, response=False)
"""At the full rate: the laser's noise, which is all that is measured then, is averaged by it."""
PLAN = """\
format = "conformance-plan/1"
profiler = "sample, drawn with seed {seed}"

[[sections]]
name = "smooth"
reference = "reference"
runs = ["runs/run-*"]
from_m = {from_m}
to_m = {to_m}

# The plate that is pushed under the laser lies beyond both stretches.
[quiescent]
source = "quiescent"
from_m = 200.0
to_m = 360.9

[bounce]
source = "bounce"
from_m = 221.7
to_m = 308.3

[distance]
known_m = {known_m}
readings_m = {readings}
"""


def write_certification(folder: Path, seed: int, report: Callable[[str], None]) -> None:
    """Write the sample into ``folder``, an empty one; ``report`` is called with each part's name.

    The reference is the road along the line that the vehicle keeps on average, as it is.
    """
    report("reference")
    road = replace(PASS, seed=seed)
    write_profile(simulate(replace(road, wander_m=0.0)).truth, folder / "reference")
    (folder / "runs").mkdir()
    for number, drive in enumerate(repeat_passes(road, RUNS), start=1):
        report(f"run-{number}")
        speed = SPEEDS_KMH[number % len(SPEEDS_KMH)]
        write_recording(
            simulate(replace(drive, speed_kmh=speed)).recording, folder / "runs" / f"run-{number}"
        )
    for test in ("quiescent", "bounce"):
        report(test)
        parked = replace(PARKED, seed=seed, manoeuvre=test)
        write_recording(simulate(parked).recording, folder / test)
    (folder / "plan.toml").write_text(_plan(seed), encoding="utf-8")


def _plan(seed: int) -> str:
    errors = np.random.default_rng(seed).normal(0.0, 0.01 * ENCODER_PERCENT, READINGS)
    readings = [round(KNOWN_M * (1.0 + float(error)), 2) for error in errors]
    return PLAN.format(seed=seed, from_m=FROM_M, to_m=TO_M, known_m=KNOWN_M, readings=readings)
