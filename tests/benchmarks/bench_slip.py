"""How far the axis of a profile is off when the encoder's wheel slips, and what helps.

Stops and brakes of three vehicles, the radius growing by 0.5 %. `encoder` has no second source;
`two passes` learns the slip by `slip_of_passes` from a brake and a pass at speed over another road.
Printed are the range of the distance's error over the drive, and the cross correlation with the
road along the true distance over 160.9 m after the IRI filter: median, and worst. Run as

    python tests/benchmarks/bench_slip.py [--seeds N] [--json FILE] [--from FILE] [--page FILE]
"""

import argparse
import json
import warnings
from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from tables import show

import floatref
from floatref.engine.road_distance import correct_distance
from floatref.measures import cross_correlation, high_pass, iri_trace
from floatref.measures.slip.two_passes import slip_of_passes
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate

PIPELINE = "road-prior-smoother-imu"
HALF_M, MAX_OFFSET_M = 80.45, 1.0
VEHICLES = "loaded-van", "minivan", "pickup"
SLIPS = 2.5, 6.0, 12.0
SOURCES = "encoder", "gnss", "optical", "two passes"
DRIVE = Scenario(
    dwell_s=5.8, laser_ahead_m=0.0, response=False, radius_percent=0.5, event_at_m=316.0
)
PASSES = {"manoeuvre": "braking", "road_seed": 900}, {"manoeuvre": "constant", "road_seed": 900}
Row = dict[str, Any]


def learn(vehicle: str, slip: float, seed: int, rate_hz: float) -> float:
    """Return the slip that two passes over one road show, each with errors of its own."""
    profiles = []
    for number, one in enumerate(PASSES):
        own = {"vehicle": vehicle, "slip_percent_per_g": slip, "rate_hz": rate_hz}
        made = simulate(replace(DRIVE, seed=1000 + 2 * seed + number, **own, **one))
        profiles.append(floatref.process(made.recording, "temporal-basic"))
    return slip_of_passes(profiles[0], profiles[1]).slip_per_g


def correlations(made: Simulation, profile: floatref.Profile) -> list[float]:
    """Return the cross correlation of every wheel path along the true distance."""
    step, found = profile.interval_m, []
    part = slice(*(round((DRIVE.event_at_m + s * HALF_M) / step) for s in (-1, 1)))
    for track in profile.tracks:
        points = step * np.arange(track.elevation.size)
        true = made.motion.tracks[track.name].road_m
        road = high_pass(np.interp(points, made.motion.distance, true), step)
        traces = (iri_trace(np.nan_to_num(z), step)[part] for z in (road, track.elevation))
        found.append(cross_correlation(*traces, step, MAX_OFFSET_M).cross_correlation)
    return found


def measure(manoeuvre: str, slip: float, source: str, seeds: int, rate_hz: float) -> Row:
    """Return the figures of all drives."""
    row: Row = {"manoeuvre": manoeuvre, "slip": slip, "source": source}
    row |= {"off_m": [], "correlation": [], "found": []}
    for vehicle, seed in product(VEHICLES, range(seeds)):
        second = source if source in ("gnss", "optical") else "none"
        own = {"vehicle": vehicle, "seed": seed, "rate_hz": rate_hz, "second_distance": second}
        made = simulate(replace(DRIVE, manoeuvre=manoeuvre, slip_percent_per_g=slip, **own))
        given = learn(vehicle, slip, seed, rate_hz) if source == "two passes" else None
        along = correct_distance(made.recording, given)
        distance = along.recording.channel("distance")
        true = np.interp(distance.times_s, made.motion.times_s, made.motion.distance)
        row["off_m"].append(round(float(np.ptp(distance.values - true)), 3))
        row["found"].append(round(along.record["slip_per_g"], 4))
        settings = {} if given is None else {"slip_per_g": given}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floatref.FloatrefWarning)
            profile = floatref.process(made.recording, PIPELINE, settings)
        row["correlation"] += [round(r, 4) for r in correlations(made, profile)]
    return row


def lines(rows: Sequence[Row]) -> list[list[str]]:
    """Return the lines of the table."""
    return [
        [
            row["manoeuvre"],
            f"{row['slip']:g}",
            row["source"],
            f"{100 * min(row['found']):.1f} to {100 * max(row['found']):.1f}",
            f"{np.median(row['off_m']):.2f}, {max(row['off_m']):.2f}",
            f"{np.median(row['correlation']):.3f}, {min(row['correlation']):.3f}",
        ]
        for row in rows
    ]


COLUMNS = (
    *("drive", "slip, % per g", "source", "found, % per g", "axis off by, m"),
    "correlation along the road",
)


def fill(page: str, table: list[list[str]]) -> str:
    """Return ``page`` with the table between its marks."""
    begin, end = "<!-- slip -->\n", "<!-- end of slip -->"
    before, _, rest = page.partition(begin)
    body = [COLUMNS, ("---", *["---:"] * (len(COLUMNS) - 1)), *table]
    text = "".join(f"| {' | '.join(line)} |\n" for line in body)
    return f"{before}{begin}\n{text}\n{end}{rest.partition(end)[2]}"


def main() -> None:
    """Print the table, measured now or from a file, and write what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--rate", type=float, default=4000.0, help="of the accelerometers")
    parser.add_argument("--json", type=Path, help="figures, written as they come")
    parser.add_argument("--from", type=Path, help="figures of an earlier call")
    parser.add_argument("--page", type=Path, help="whose table is replaced")
    given, rows = parser.parse_args(), list[Row]()
    if vars(given)["from"]:
        rows = json.loads(vars(given)["from"].read_text(encoding="utf-8"))
    for case in [] if rows else product(("stop", "braking"), SLIPS, SOURCES):
        rows.append(measure(*case, given.seeds, given.rate))
        print(*lines(rows[-1:])[0], sep=" | ", flush=True)
        if given.json:
            given.json.write_text(json.dumps(rows), encoding="utf-8")
    show("The axis of a profile when the encoder's wheel slips", COLUMNS, lines(rows), 140)
    if given.page:
        page = given.page.read_text(encoding="utf-8")
        given.page.write_text(fill(page, lines(rows)), encoding="utf-8")


if __name__ == "__main__":
    main()
