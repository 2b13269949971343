"""Whether settings that were tuned on one day do on others: `floatref tune` seen from outside.

Six preliminary runs on one road are tuned to; the settings are then used with other errors of the
sensors, other roads, other vehicles and worse sensors. Printed are the mean loss over the runs
(1 - cross correlation, and the error of IRI or peak as a share) and the lowest cross correlation,
with the values that tuning began with and with those that it found. Usage:

    python tests/benchmarks/bench_tuning.py [--pipeline NAME] [--start default|at-rest]
        [--runs NAME...] [--days NAME...]
"""

import argparse
import sys
import time
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table

from floatref.engine.run import run
from floatref.tuning import tune
from floatref.tuning.preparation import prepare
from floatref.tuning.run_scores import Scores
from floatref.tuning.tune import DEFAULT
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.proving_ground import Scenario, simulate

RUNS: Mapping[str, Mapping[str, Any]] = {
    "constant_8": {"manoeuvre": "constant", "speed_kmh": 8.0},
    "constant_72": {"manoeuvre": "ref_72"},
    "brake_0.16g": {"manoeuvre": "brk_49-22_0.16g"},
    "brake_0.39g": {"manoeuvre": "brk_72-29_0.39g"},
    "stop_2.1s": {"manoeuvre": "sg_2.1s_0.33g"},
    "stop_10.7s": {"manoeuvre": "sg_10.7s_0.20g"},
}
"""One of each kind that section 6.4.4 recommends."""
DAYS: Mapping[str, Mapping[str, Any]] = {
    "tuned": {"road_seed": 11, "seed": 100},
    "other errors": {"road_seed": 11, "seed": 200},
    "other road": {"road_seed": 12, "seed": 300},
    "asphalt": {"road_seed": 13, "seed": 400, "road": "sayers-asphalt-long-waves"},
    "pickup": {"road_seed": 14, "seed": 500, "vehicle": "pickup"},
    "errors doubled": {"road_seed": 15, "seed": 600, "sensors": 2.0},
}
"""The first is tuned to."""
RATE_HZ = 1000.0
"""Densities hold at any rate; at this one a tuning takes minutes."""
STARTS: Mapping[str, Mapping[str, float]] = {
    "default": {},
    "at-rest": {
        "acceleration_density": 4.9e-5,
        "acceleration_walk": 3.1e-6,
        "pitch_rate_density": 1.33e-5,
        "pitch_rate_walk": 2.2e-7,
        "roll_rate_walk": 2.2e-7,
    },
}
"""Where tuning begins: the pipeline's own values, or what sensors at rest show."""


def day(name: str, runs: Sequence[str]) -> tuple[dict[str, Recording], Profile]:
    """Return recordings of a day, and as their reference another pass at 72 km/h."""
    usual = {**DAYS[name], "rate_hz": RATE_HZ}
    recordings = {}
    for number, each in enumerate(runs):
        changed = {**usual, **RUNS[each], "seed": usual["seed"] + number}
        recordings[each] = simulate(Scenario.from_dict(changed)).recording
    passed = {**usual, "manoeuvre": "ref_72", "seed": usual["seed"] + 99}
    recording = simulate(Scenario.from_dict(passed)).recording
    return recordings, run(recording, "temporal-basic").profile


def figures(scores: Mapping[str, Scores]) -> list[str]:
    """Return mean loss and lowest cross correlation."""
    losses = [sum(s.loss for s in each) / len(each) for each in scores.values()]
    lowest = min(s.cross_correlation for each in scores.values() for s in each)
    return [f"{sum(losses) / len(losses):.4f}", f"{lowest:.4f}"]


def main() -> None:
    """Tune to the first day and print what comes of it on every day."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--pipeline", default=DEFAULT)
    parser.add_argument("--start", choices=list(STARTS), default="default")
    parser.add_argument("--runs", nargs="+", choices=list(RUNS), default=list(RUNS))
    parser.add_argument("--days", nargs="+", choices=list(DAYS), default=list(DAYS))
    options = parser.parse_args()
    given = STARTS[options.start]
    recordings, reference = day("tuned", options.runs)
    began = time.perf_counter()
    tuning = tune(
        recordings, reference, options.pipeline, given, tell=lambda s: print(s, file=sys.stderr)
    )
    wall_s = time.perf_counter() - began
    del recordings
    table = Table(title=f"{options.pipeline}, from {options.start} values: {dict(tuning.values)}")
    for column in ("day", "loss nominal", "ρ", "loss before", "ρ", "loss after", "ρ"):
        table.add_column(column, justify="right" if column != "day" else "left")
    for name in options.days:
        recordings, reference = day(name, options.runs)
        nominal = prepare(recordings, reference, options.pipeline, given)
        rows = [figures(nominal.nominal)]
        for settings in (given, tuning.settings):
            scores = {
                each: made.comparison.scores(
                    run(made.recording, options.pipeline, settings).profile
                )
                for each, made in nominal.runs.items()
            }
            rows.append(figures(scores))
        table.add_row(name, *(cell for row in rows for cell in row))
    Console(width=140).print(table)
    print(f"{tuning.combinations} combinations, {tuning.profiles} profiles, {wall_s:.0f} s")
    for item in tuning.sensitivity:
        rise, name = item.worst
        print(f"{item.setting}: loss rises by up to {rise:.4f} ({name}) over 0.71 to 1.41 times it")


if __name__ == "__main__":
    main()
