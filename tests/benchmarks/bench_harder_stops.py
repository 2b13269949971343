"""What roads, sensors and vehicles that are not kind do to one stop: one change at a time.

A stop of print (0.2 g from 72 km/h, 5.8 s, on to 58 km/h), its encoder slipping by 2.5 % per g and
its laser on the axis of the accelerometer, on two roads with sensor errors of their own. Profiles
are compared with the road under the laser, high-pass filtered as they are, over 160.9 m about the
stop, along the true distance and along the encoder's. Run as

    python tests/benchmarks/bench_harder_stops.py [--only NAME...] [--json FILE]
        [--read FILE] [--page PAGE...]

`--json` keeps the figures, `--read` takes kept ones in place of measuring, and `--page` writes the
rows of a pipeline into the pages that quote it.
"""

import argparse
import json
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from tables import show

from floatref.measures import high_pass, on_common_grid
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.stretches import points
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.passes import Driven, Processing
from floatref_conformance.table.stops.stop_scores import STRETCH_M, along_encoder, stop_scores

PIPELINES = (
    "road-prior-smoother",
    "kalman-smoother-reflection",
    "kalman-smoother-constant-height-attitude",
)
STOP: Mapping[str, Any] = {
    "manoeuvre": "stop",
    "speed_kmh": 72.0,
    "deceleration_g": 0.2,
    "dwell_s": 5.8,
    "final_speed_kmh": 58.0,
    "event_at_m": 316.0,
    "length_m": 550.0,
    "slip_percent_per_g": 2.5,
    "laser_ahead_m": 0.0,
    "rate_hz": 8000.0,
    "response": False,
}
CHANGES: Mapping[str, Mapping[str, float]] = {
    "nothing": {},
    "no slip": {"slip_percent_per_g": 0.0},
    "slip 12 % per g": {"slip_percent_per_g": 12.0},
    "crown 50 mm": {"crown_mm": 50.0},
    "crown 100 mm": {"crown_mm": 100.0},
    "crown 100 mm, 60 m ahead": {"crown_mm": 100.0, "crown_at_m": 256.0},
    "hump 150 mm over 10 m": {"crown_mm": 150.0, "crown_length_m": 10.0},
    "grade break 1 %": {"break_percent": 1.0},
    "grade break 2 %": {"break_percent": 2.0},
    "grade break 4 %": {"break_percent": 4.0},
    "laser 0.105 m ahead": {"laser_ahead_m": 0.105},
    "laser 0.3 m ahead": {"laser_ahead_m": 0.3},
    "latency 1 ms": {"latency_ms": 1.0},
    "latency 3 ms": {"latency_ms": 3.0},
    "friction 2000 N·m": {"friction_nm": 2000.0},
    "progressive springs 50 1/m²": {"progression_per_m2": 50.0},
}
"""What each row changes of `STOP`; crowns are 20 m and grade breaks 30 m long, and at the stop."""
SEEDS = (1, 2)
AXES = ("true", "encoder")
COLUMNS = ("what changes", "cross corr., true distance", "encoder's", "IRI error, %")
COLUMNS += ("RMS, mm, true distance", "encoder's", "within 2 σ, %, true distance", "encoder's")
SHOWN = (
    ("cross_correlation", AXES, 3),
    ("iri_error_percent", AXES[:1], 1),
    ("rms_mm", AXES, 1),
    ("within_percent", AXES, 0),
)
"""Figure, distances along which it is shown, and digits."""
Figures = dict[str, float]


def scenario(change: str, seed: int) -> Scenario:
    """Return the stop with ``change``, on the road and with the errors of ``seed``."""
    return Scenario(seed=seed, **{**STOP, **CHANGES[change]})


def filtered(profile: Profile) -> Profile:
    """Return the truth after the high-pass that profiles have."""
    interval_m = profile.interval_m
    tracks = (ProfileTrack.of(t.name, high_pass(t.elevation, interval_m)) for t in profile.tracks)
    return replace(profile, tracks=tuple(tracks))


def rms_mm(reference: Profile, profile: Profile, name: str) -> float:
    """Return the RMS difference in mm of one wheel path within the stretch."""
    found, true = on_common_grid(profile, reference)
    inside = points(found, *STRETCH_M)
    error = (found.track(name).elevation - true.track(name).elevation)[inside]
    return 1e3 * float(np.sqrt(np.mean(error**2)))


def path_figures(driven: Driven, profile: Profile) -> list[Figures]:
    """Return the figures of every wheel path of ``profile``, along both distances."""
    truths = driven.truth, along_encoder(driven.truth, driven.encoder_m)
    references = [filtered(truth) for truth in truths]
    found = []
    for name, scores in stop_scores(driven.truth, driven.encoder_m, profile).items():
        rms = [rms_mm(reference, profile, name) for reference in references]
        valid = profile.track(name).valid[points(profile, *STRETCH_M)]
        found.append(
            {
                "cross_correlation_true": scores.cross_correlation,
                "cross_correlation_encoder": scores.cross_correlation_encoder,
                "iri_error_percent_true": scores.iri_error_percent,
                "iri_error_percent_encoder": scores.iri_error_encoder_percent,
                "rms_mm_true": rms[0],
                "rms_mm_encoder": rms[1],
                "within_percent_true": scores.within_two_sigma_true_distance_percent,
                "within_percent_encoder": scores.within_two_sigma_percent,
                "valid_percent": 100.0 * float(np.mean(valid)),
            }
        )
    return found


def measured(processing: Processing, change: str) -> dict[str, list[Figures]]:
    """Return the figures of every pipeline's wheel paths over `SEEDS`; fewer where one refuses."""
    found: dict[str, list[Figures]] = {name: [] for name in PIPELINES}
    for seed in SEEDS:
        driven = processing.drive(scenario(change, seed), f"{change}, seed {seed}")
        for name, profile in driven.profiles.items():
            try:
                found[name] += path_figures(driven, profile)
            except DeviceError as error:
                print(f"{change}, {name}: {error}", file=sys.stderr)
    return found


def mean(paths: list[Figures]) -> Figures:
    """Return the means over wheel paths, of magnitudes for the IRI's error, and the lowest."""
    means = {}
    for name in paths[0]:
        values = [abs(path[name]) if "iri" in name else path[name] for path in paths]
        means[name] = round(float(np.mean(values)), 4)
    lowest = min(path["cross_correlation_true"] for path in paths)
    return means | {"lowest_cross_correlation_true": round(lowest, 4)}


def cells(row: Mapping[str, Any]) -> list[str]:
    """Return the cells of one line."""
    shown = [row["change"]]
    for name, axes, digits in SHOWN:
        shown += [f"{row[f'{name}_{axis}']:.{digits}f}" for axis in axes]
    return shown


def table(rows: list[dict[str, Any]], pipeline: str) -> str:
    """Return the Markdown rows of ``pipeline``."""
    return "".join(f"| {' | '.join(cells(row))} |\n" for row in rows if row["pipeline"] == pipeline)


def marks(pipeline: str) -> tuple[str, str]:
    """Return the comments between which the rows of ``pipeline`` stand on a page."""
    return f"<!-- harder stops: {pipeline} -->\n", f"<!-- end of {pipeline} -->"


def fill(page: str, rows: list[dict[str, Any]]) -> str:
    """Return ``page`` with the tables of the pipelines that have marks on it."""
    head = f"| {' | '.join(COLUMNS)} |\n|---|{'---:|' * (len(COLUMNS) - 1)}\n"
    for pipeline in PIPELINES:
        begin, end = marks(pipeline)
        if begin in page:
            before, _, rest = page.partition(begin)
            shown = "\n" + head + table(rows, pipeline) + "\n"
            page = before + begin + shown + end + rest.partition(end)[2]
    return page


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", default=list(CHANGES), help="names of changes")
    parser.add_argument("--json", type=Path, help="figures, written as they come")
    parser.add_argument("--read", type=Path, help="figures that were kept, in place of measuring")
    parser.add_argument("--page", type=Path, nargs="+", default=[], help="pages to be filled")
    return parser.parse_args()


def measure_all(changes: list[str], target: Path | None) -> list[dict[str, Any]]:
    """Return the rows of ``changes``, printed and written to ``target`` as they come."""
    processing, rows = Processing(PIPELINES), list[dict[str, Any]]()
    for change in changes:
        for pipeline, paths in measured(processing, change).items():
            rows.append({"pipeline": pipeline, "change": change, **mean(paths)})
            print(pipeline, *cells(rows[-1]), sep=" | ", flush=True)
        if target:
            target.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    return rows


def main() -> None:
    """Measure every change, print the tables, and write what is asked for."""
    given = arguments()
    if given.read:
        rows = json.loads(given.read.read_text(encoding="utf-8"))
    else:
        rows = measure_all(given.only, given.json)
    for pipeline in PIPELINES:
        lines = [cells(row) for row in rows if row["pipeline"] == pipeline]
        show(pipeline, COLUMNS, lines, 120)
    for page in given.page:
        page.write_text(fill(page.read_text(encoding="utf-8"), rows), encoding="utf-8")


if __name__ == "__main__":
    main()
