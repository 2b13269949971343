"""How a stop is measured on streets that are not plain, with mounts that are not ideal.

Every case is a stop of the loaded van at 0.2 g with a standstill of 5.8 s on a road of 1.8 m/km,
with one thing changed. Three pipelines process the same recordings. Their profiles are compared
with the road under the laser over 160.9 m about the stop, after the IRI filter, along the true
distance, and along the encoder's, whose error is then that of the axis. Run as

    python tests/benchmarks/bench_streets.py [--seeds N] [--only KIND...] [--rate HZ]
        [--json FILE] [--from FILE] [--page FILE...]

It prints the three side by side, and then each with all figures, which `--page` writes into pages.
"""

import argparse
import json
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from tables import show

import floatref
from floatref.measures import cross_correlation, high_pass, iri_trace
from floatref.values.arrays import FloatArray
from floatref.values.profile import ProfileTrack
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.table.families.conditions import SINGLE

PIPELINES = {
    "road prior": "road-prior-smoother",
    "reflection": "kalman-smoother-reflection",
    "constants": "kalman-smoother-constant-height-attitude",
}
"""Pipelines by their names in the tables."""
STOP = Scenario(
    manoeuvre="stop", dwell_s=5.8, slip_percent_per_g=2.5, laser_ahead_m=0.105, response=False
)
HALF_M, MAX_OFFSET_M = 80.45, 1.0
CASES: dict[str, Mapping[str, float]] = {
    "as before: laser at 0 m, slip 0.3 %/g": {"laser_ahead_m": 0.0, "slip_percent_per_g": 0.3},
    "laser at 0 m, slip 2.5 %/g": {"laser_ahead_m": 0.0},
    "plain road: laser at 0.105 m, slip 2.5 %/g": SINGLE["plain stop"],
    "crown, 50 mm over 20 m": SINGLE["crown 50 mm"],
    "crown, 100 mm over 20 m": SINGLE["crown 100 mm"],
    "hump, 150 mm over 10 m": SINGLE["hump 150 mm"],
    "grade break, 1 % in 30 m": {"break_percent": 1.0},
    "grade break, 2 % in 30 m": SINGLE["break 2 %"],
    "grade break, 4 % in 30 m": SINGLE["break 4 %"],
    "laser 0.3 m ahead": SINGLE["laser 0.3 m"],
    "latency 1 ms": {"latency_ms": 1.0},
    "latency 3 ms": SINGLE["latency 3 ms"],
    "latency 3 ms, laser at 0 m": {**SINGLE["latency 3 ms"], "laser_ahead_m": 0.0},
    "friction 2000 N·m": SINGLE["friction"],
    "progressive springs, 50/m²": SINGLE["springs"],
    "slip 12 %/g": SINGLE["slip 12 %/g"],
}
"""What is changed, by its name in the tables. Crown and break lie at the stop."""
AXES = "true", "encoder"
COLUMNS = (
    *("case", "true distance", "lowest", "encoder", "lowest", "IRI, %", "largest"),
    *("RMS, mm", "within 2 σ, %"),
)
"""Correlations along both axes, IRI along the true distance, the last two along both."""
Row = dict[str, Any]
"""Case, pipeline and axis, and the figures of every seed and wheel path."""


def axis_of(made: Simulation, axis: str) -> FloatArray:
    """Return the distance at every sample of the motion, in m, shape (n,)."""
    if axis == "true":
        return made.motion.distance
    encoder = made.recording.channel("distance")
    counted = np.interp(made.motion.times_s, encoder.times_s, encoder.values)
    return np.asarray(counted - counted[0])


def compare(
    made: Simulation, track: ProfileTrack, interval_m: float, axis: str
) -> dict[str, float]:
    """Return how a wheel path agrees with the road along one axis."""
    distance = axis_of(made, axis)
    points = interval_m * np.arange(track.elevation.size)
    road = high_pass(np.interp(points, distance, made.motion.tracks[track.name].road_m), interval_m)
    middle = distance[np.argmax(made.motion.distance >= STOP.event_at_m)]
    part = slice(round((middle - HALF_M) / interval_m), round((middle + HALF_M) / interval_m))
    expected = iri_trace(road, interval_m)[part]
    trace = iri_trace(track.elevation, interval_m)[part]
    error = (track.elevation - road)[part]
    assert track.sigma is not None
    found = cross_correlation(expected, trace, interval_m, MAX_OFFSET_M)
    return {
        "correlation": found.cross_correlation,
        "iri_percent": 100.0 * (np.abs(trace).mean() / np.abs(expected).mean() - 1.0),
        "rms_mm": 1e3 * np.sqrt(np.mean(error**2)),
        "within_percent": 100.0 * np.mean(np.abs(error) <= 2.0 * track.sigma[part]),
    }


def measure(case: str, seeds: int, rate_hz: float) -> list[Row]:
    """Return a row for each pipeline and axis."""
    rows: dict[tuple[str, str], Row] = {
        (name, axis): {"case": case, "pipeline": name, "axis": axis}
        for name, axis in product(PIPELINES, AXES)
    }
    for seed in range(seeds):
        made = simulate(replace(STOP, seed=seed, rate_hz=rate_hz, **CASES[case]))
        for name, pipeline in PIPELINES.items():
            profile = quietly(made, pipeline)
            for track, axis in product(profile.tracks, AXES):
                for figure, value in compare(made, track, profile.interval_m, axis).items():
                    rows[name, axis].setdefault(figure, []).append(round(float(value), 4))
    return list(rows.values())


def quietly(made: Simulation, pipeline: str) -> floatref.Profile:
    """Return the profile, without warnings of what was done to the recording."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        return floatref.process(made.recording, pipeline)


def along(rows: Sequence[Row], case: str, pipeline: str, axis: str) -> Row:
    """Return one row."""
    wanted = case, pipeline, axis
    return next(r for r in rows if (r["case"], r["pipeline"], r["axis"]) == wanted)


def cells(rows: Sequence[Row], case: str, pipeline: str) -> list[str]:
    """Return one line of the table of a pipeline: medians, and what is farthest off."""
    true, encoder = (along(rows, case, pipeline, axis) for axis in AXES)
    iri = true["iri_percent"]
    return [
        case,
        *(f"{pick(r['correlation']):.3f}" for r in (true, encoder) for pick in (np.median, min)),
        f"{np.median(iri):+.1f}",
        f"{max(iri, key=abs):+.1f}",
        *(
            " / ".join(f"{np.median(row[name]):.{digits}f}" for row in (true, encoder))
            for name, digits in (("rms_mm", 1), ("within_percent", 0))
        ),
    ]


def beside(rows: Sequence[Row], case: str) -> list[str]:
    """Return one line with the correlations of all pipelines, median (lowest)."""
    line = [case]
    for axis in AXES:
        for name in PIPELINES:
            found = along(rows, case, name, axis)["correlation"]
            line.append(f"{np.median(found):.3f} ({min(found):.3f})")
    return line


def fill(page: str, rows: Sequence[Row]) -> str:
    """Return ``page`` with the tables of those pipelines that it has marks for."""
    for name in PIPELINES:
        begin, end = f"<!-- streets: {name} -->\n", f"<!-- end of {name} -->"
        if begin in page:
            before, _, rest = page.partition(begin)
            lines = [COLUMNS, ("---", *["---:"] * (len(COLUMNS) - 1))]
            lines += [cells(rows, case, name) for case in dict.fromkeys(r["case"] for r in rows)]
            table = "".join(f"| {' | '.join(line)} |\n" for line in lines)
            page = f"{before}{begin}\n{table}\n{end}{rest.partition(end)[2]}"
    return page


def arguments() -> argparse.Namespace:
    """Return what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", nargs="+", default=[""], help="begins of cases")
    parser.add_argument("--rate", type=float, default=4000.0, help="of the accelerometers")
    parser.add_argument("--json", type=Path, help="figures, written as they come")
    parser.add_argument("--from", type=Path, help="figures of an earlier call")
    parser.add_argument("--page", nargs="+", type=Path, default=[], help="whose table is replaced")
    return parser.parse_args()


def main() -> None:
    """Print the tables, measured now or from a file, and write what is asked for."""
    given, earlier = arguments(), None
    if vars(given)["from"]:
        earlier = json.loads(vars(given)["from"].read_text(encoding="utf-8"))
    rows = list[Row](earlier or ())
    for case in [] if earlier else (c for c in CASES if c.startswith(tuple(given.only))):
        rows += measure(case, given.seeds, given.rate)
        print(*beside(rows, case), sep=" | ", flush=True)
        if given.json:
            text = ",\n".join(json.dumps(row) for row in rows)
            given.json.write_text(f"[{text}]\n", encoding="utf-8")
    cases = list(dict.fromkeys(row["case"] for row in rows))
    columns = [f"{name}, {axis}" for axis in AXES for name in PIPELINES]
    title = "Cross correlation with the road about a stop, median (lowest), along both distances"
    show(title, ("case", *columns), [beside(rows, case) for case in cases], 170)
    for name, pipeline in PIPELINES.items():
        show(pipeline, COLUMNS, [cells(rows, case, name) for case in cases], 140)
    for page in given.page:
        page.write_text(fill(page.read_text(encoding="utf-8"), rows), encoding="utf-8")


if __name__ == "__main__":
    main()
