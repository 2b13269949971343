"""The 17 runs of the dissertation (Tables 5.1 and 5.2, section 5.2) and the reference pass.

The test section starts `SECTION_START_M` into a recording. The last scored point lies
280.9 m into the section; a recording goes on for 119.1 m more, so that the filters run out
beyond it.
"""

import csv
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.display.similar_names import suggest
from floatref_conformance.proving_ground.drives import manoeuvres
from floatref_conformance.proving_ground.drives.drive import Drive

SECTION_START_M = 100.0
"""Where the test section starts in the recording, in m."""
RECORDING_LENGTH_M = 500.0
"""True distance driven in every run, in m."""
REFERENCE_RUN = "ref_72"
KMH = 1 / 3.6
"""One km/h, in m/s."""
NEAR_16_MPS = 16.4 / 3.6
"""Speed of `const_16` in m/s. Section 5.2 has "near 16 km/hr", and the pass shows that suppression
leaves valid what is measured at that speed or above: so it was never below the 10 mph (4.4704 m/s,
16.09 km/h) at which suppression begins, and below 16.5 km/h, which would be rounded to 17."""
CREEP_BAND = (4 * KMH, 5 * KMH)
"""Speeds in m/s between which `const_5` ran."""


@dataclass(frozen=True)
class Run:
    """One run as published.

    Attributes:
        name: its designation.
        kind: "stop", "near-stop", "braking" or "constant".
        initial_speed_kmh: before the event, in km/h.
        event_speed_kmh: at the end of the brake, in km/h; 0 for a stop.
        final_speed_kmh: after the event, in km/h.
        mean_deceleration_g: of the brake in g; of a stop from 70.5 to 0.5 km/h.
        dwell_s: of the stop, or of the coast of a near stop, in s.
        event_location_m: of the stop or the brake's release, in m from the section's start.
    """

    name: str
    kind: str
    initial_speed_kmh: float
    event_speed_kmh: float
    final_speed_kmh: float
    mean_deceleration_g: float | None = None
    dwell_s: float | None = None
    event_location_m: float | None = None


def _read() -> Mapping[str, Run]:
    text = (files("floatref_conformance.proving_ground") / "data" / "runs.csv").read_text(
        encoding="utf-8"
    )
    runs = [_run_of(row) for row in csv.DictReader(text.splitlines())]
    runs.append(Run(REFERENCE_RUN, "constant", 72.0, 72.0, 72.0))
    return MappingProxyType({run.name: run for run in runs})


def _run_of(row: Mapping[str, str]) -> Run:
    return Run(
        row["run"],
        row["kind"],
        float(row["initial_speed_kmh"]),
        float(row["event_speed_kmh"]),
        float(row["final_speed_kmh"]),
        *(
            float(row[name]) if row[name] else None
            for name in ("average_decel_g", "dwell_s", "event_location_m")
        ),
    )


RUNS: Mapping[str, Run] = _read()
"""The runs of Tables 5.1 and 5.2 by name, in the order of publication, `ref_72` last."""


@cache
def run_drive(name: str) -> Drive:
    """Return the drive of a run, `RECORDING_LENGTH_M` long; InputError for an unknown name."""
    if name not in RUNS:
        raise InputError(f"run {name}: unknown; {suggest(name, RUNS, 'choose from')}")
    return _DRIVES[RUNS[name].kind](RUNS[name])


def _event(run: Run) -> tuple[float, float]:
    """Return mean deceleration in m/s² and true distance of the event in m."""
    if run.mean_deceleration_g is None or run.event_location_m is None:
        raise InputError(f"run {run.name}: needs average_decel_g and event_location_m")
    return run.mean_deceleration_g * STANDARD_GRAVITY, SECTION_START_M + run.event_location_m


def _stop(run: Run) -> Drive:
    deceleration, place = _event(run)
    return manoeuvres.stop(
        run.initial_speed_kmh * KMH,
        deceleration,
        place,
        run.dwell_s or 0.0,
        run.final_speed_kmh * KMH,
        RECORDING_LENGTH_M,
    )


def _near_stop(run: Run) -> Drive:
    deceleration, place = _event(run)
    return manoeuvres.near_stop(
        run.initial_speed_kmh * KMH,
        run.event_speed_kmh * KMH,
        deceleration,
        place,
        run.dwell_s or 0.0,
        run.final_speed_kmh * KMH,
        RECORDING_LENGTH_M,
    )


def _braking(run: Run) -> Drive:
    deceleration, place = _event(run)
    return manoeuvres.braking(
        run.initial_speed_kmh * KMH,
        run.event_speed_kmh * KMH,
        deceleration,
        place,
        RECORDING_LENGTH_M,
    )


def _constant(run: Run) -> Drive:
    if run.name == "const_5":
        return manoeuvres.creeping(*CREEP_BAND, RECORDING_LENGTH_M)
    speed = NEAR_16_MPS if run.name == "const_16" else run.initial_speed_kmh * KMH
    return manoeuvres.constant(speed, RECORDING_LENGTH_M)


_DRIVES: Mapping[str, Callable[[Run], Drive]] = MappingProxyType(
    {"stop": _stop, "near-stop": _near_stop, "braking": _braking, "constant": _constant}
)
