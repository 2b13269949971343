"""What a laser away from its accelerometer costs every pipeline, and what one that is late costs.

Every drive is made twice with the same road and errors: with the laser under its accelerometer and
in time, and without. The cost is the difference of the cross correlations with the road after the
IRI filter, along the encoder's distance over 160.9 m: about the stop, or at constant speed about
the same place. `ignored` takes a laser ahead for one in its place; `unknown axles` leaves them out
of the setup. Run as

    python tests/benchmarks/bench_laser_place.py [--seeds N] [--rate HZ] [--json FILE]
        [--from FILE] [--page FILE]

It prints tables over five vehicles, which `--page` writes into a page.
"""

import argparse
import json
import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from tables import show

import floatref
from floatref.measures import cross_correlation, high_pass, iri_trace
from floatref.values.arrays import FloatArray
from floatref.values.recording import ORIGIN, Recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES

HALF_M, MAX_OFFSET_M = 80.45, 1.0
LEVER_M, LATENCY_MS = 0.3, 3.0
DRIVE = Scenario(
    dwell_s=5.8, slip_percent_per_g=0.0, laser_ahead_m=0.0, response=False, event_at_m=316.0
)
MANOEUVRES = "constant", "stop"
PIPELINES = [name for name in floatref.pipelines() if not name.startswith("response")]
Change = Callable[[Recording], Recording]
Row = dict[str, Any]


def without_offset(recording: Recording) -> Recording:
    """Return the recording of an operator who does not state the laser's place."""
    setup = recording.setup
    tracks = {t: replace(s, laser_offset_m=ORIGIN) for t, s in setup.tracks.items()}
    return replace(recording, setup=replace(setup, tracks=tracks))


def without_axles(recording: Recording) -> Recording:
    """Return the recording of an operator who does not state where the axles are."""
    return replace(recording, setup=replace(recording.setup, axles=None))


def as_recorded(recording: Recording) -> Recording:
    """Return the recording itself."""
    return recording


CASES: dict[str, tuple[dict[str, float], Change]] = {
    "in place": ({}, as_recorded),
    "0.3 m, ignored": ({"laser_ahead_m": LEVER_M}, without_offset),
    "0.3 m": ({"laser_ahead_m": LEVER_M}, as_recorded),
    "-0.3 m": ({"laser_ahead_m": -LEVER_M}, as_recorded),
    "0.105 m": ({"laser_ahead_m": 0.105}, as_recorded),
    "0.3 m, unknown axles": ({"laser_ahead_m": LEVER_M}, without_axles),
    "3 ms": ({"latency_ms": LATENCY_MS}, as_recorded),
}
"""What is done to the laser, and to what the recording says of it."""


def encoder_of(made: Simulation) -> FloatArray:
    """Return the encoder's distance at every sample of the motion, in m."""
    channel = made.recording.channel("distance")
    counted = np.interp(made.motion.times_s, channel.times_s, channel.values)
    return np.asarray(counted - counted[0])


def correlations(made: Simulation, profile: floatref.Profile) -> list[float]:
    """Return the cross correlation of every wheel path about the event."""
    distance, step = encoder_of(made), profile.interval_m
    middle = distance[np.argmax(made.motion.distance >= DRIVE.event_at_m)]
    part = slice(round((middle - HALF_M) / step), round((middle + HALF_M) / step))
    found = []
    for track in profile.tracks:
        points = step * np.arange(track.elevation.size)
        road = high_pass(np.interp(points, distance, made.motion.tracks[track.name].road_m), step)
        expected = iri_trace(road, step)[part]
        trace = iri_trace(np.nan_to_num(track.elevation), step)[part]
        agreed = cross_correlation(expected, trace, step, MAX_OFFSET_M)
        found.append(agreed.cross_correlation)
    return found


def measure(vehicle: str, manoeuvre: str, seed: int, rate_hz: float) -> list[Row]:
    """Return a row for each case and pipeline."""
    rows = []
    for case, (numbers, change) in CASES.items():
        drive = {"vehicle": vehicle, "manoeuvre": manoeuvre, "seed": seed, "rate_hz": rate_hz}
        made = simulate(replace(DRIVE, **drive, **numbers))
        recording = change(made.recording)
        for pipeline in PIPELINES:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", floatref.FloatrefWarning)
                profile = floatref.process(recording, pipeline)
            found = [round(r, 5) for r in correlations(made, profile)]
            laser = profile.provenance["laser"]
            later = [track in laser and "later_s" in laser[track] for track in made.motion.tracks]
            own = {"case": case, "pipeline": pipeline, "correlation": found, "skew_found": later}
            rows.append({**drive, **own})
    return rows


def costs(rows: Sequence[Row], case: str, pipeline: str, manoeuvre: str) -> FloatArray:
    """Return what a case costs, by drive and wheel path; 3 ms where it was found or not."""
    found, late = [], {"3 ms, found": True, "3 ms, not found": False}
    for row in rows:
        wanted = "3 ms" if case in late else case, pipeline, manoeuvre
        if (row["case"], row["pipeline"], row["manoeuvre"]) != wanted:
            continue
        own = ("vehicle", "seed", "manoeuvre", "pipeline")
        base = next(r for r in rows if r["case"] == "in place" and all(r[k] == row[k] for k in own))
        pairs = zip(base["correlation"], row["correlation"], row["skew_found"], strict=True)
        found += [a - b for a, b, known in pairs if late.get(case, known) == known]
    return np.array(found)


def pair(values: FloatArray) -> str:
    """Return median and largest cost."""
    return f"{np.median(values):.3f}, {values.max():.3f}" if values.size else "–"


def table(rows: Sequence[Row], manoeuvre: str) -> tuple[tuple[str, ...], list[list[str]]]:
    """Return columns and lines of the table of a manoeuvre: median and largest cost."""
    cases = [c for c in CASES if c not in ("in place", "3 ms")] + ["3 ms, not found"]
    cases += ["3 ms, found"] * (manoeuvre == "stop")
    lines = []
    for pipeline in PIPELINES:
        base = [
            r["correlation"]
            for r in rows
            if (r["case"], r["pipeline"], r["manoeuvre"]) == ("in place", pipeline, manoeuvre)
        ]
        own = [pair(costs(rows, case, pipeline, manoeuvre)) for case in cases]
        lines.append([f"`{pipeline}`", f"{np.median(base):.3f}", *own])
    return ("pipeline", "in place", *cases), lines


def vehicles(rows: Sequence[Row]) -> tuple[tuple[str, ...], list[list[str]]]:
    """Return the costs of 0.3 m with a modelled and with a measured pitch, by vehicle."""
    lines = []
    for vehicle in VEHICLES:
        line = [vehicle]
        own = [r for r in rows if r["vehicle"] == vehicle]
        for pipeline, manoeuvre in product(
            ("road-prior-smoother", "kalman-smoother-reflection"), MANOEUVRES
        ):
            line += [
                pair(costs(own, case, pipeline, manoeuvre)) for case in ("0.3 m, ignored", "0.3 m")
            ]
        lines.append(line)
    heads = (f"{how}, {m}, {c}" for how, m, c in product(
        ("modelled", "measured"), MANOEUVRES, ("ignored", "0.3 m")))  # fmt: skip
    return ("vehicle", *heads), lines


def fill(page: str, name: str, columns: tuple[str, ...], lines: list[list[str]]) -> str:
    """Return ``page`` with the table between the marks of ``name``."""
    begin, end = f"<!-- laser: {name} -->\n", f"<!-- end of {name} -->"
    before, _, rest = page.partition(begin)
    body = [columns, ("---", *["---:"] * (len(columns) - 1)), *lines]
    text = "".join(f"| {' | '.join(line)} |\n" for line in body)
    return f"{before}{begin}\n{text}\n{end}{rest.partition(end)[2]}"


def arguments() -> argparse.Namespace:
    """Return what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--rate", type=float, default=4000.0, help="of the accelerometers")
    parser.add_argument("--json", type=Path, help="figures, written as they come")
    parser.add_argument("--from", type=Path, help="figures of an earlier call")
    parser.add_argument("--page", type=Path, help="whose tables are replaced")
    return parser.parse_args()


def main() -> None:
    """Print the tables, measured now or from a file, and write what is asked for."""
    given, rows = arguments(), list[Row]()
    if vars(given)["from"]:
        rows = json.loads(vars(given)["from"].read_text(encoding="utf-8"))
    drives = [] if rows else product(VEHICLES, MANOEUVRES, range(given.seeds))
    for drive in drives:
        rows += measure(*drive, given.rate)
        print(*drive, flush=True)
        if given.json:
            text = ",\n".join(json.dumps(row) for row in rows)
            given.json.write_text(f"[{text}]\n", encoding="utf-8")
    tables = {m: table(rows, m) for m in MANOEUVRES} | {"vehicles": vehicles(rows)}
    page = given.page.read_text(encoding="utf-8") if given.page else ""
    for name, (columns, lines) in tables.items():
        show(f"Cost in cross correlation, median and largest: {name}", columns, lines, 170)
        page = fill(page, name, columns, lines) if page else page
    if given.page:
        given.page.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
