"""Class adequate of the default pipeline, and what no nominal profiler can do better.

Every seeded case of the driving checks is judged by the limits of class adequate, along the true
distance. Beside the default pipeline stands a profile without any error, at the places that the
encoder counts, less a slip of c % per g. Nominal sensors count one wheel, which says nothing about
its own slip, and the edition draws 3 to 12 for every drive anew, so that no drive says anything
about that of the next one.

A check that fails with each c is beyond any nominal profiler with these seeds.

    python tests/benchmarks/bench_adequate_bound.py --seeds 10 --jobs 2 [--json FILE]
"""

import argparse
import json
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from rich.progress import track
from tables import show

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving.check import DrivingCheck, driving_checks
from floatref_conformance.checks.encoder_axis import EncoderAxis
from floatref_conformance.checks.interface import Taken
from floatref_conformance.checks.scoring import filter_truth
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.builtin import RECOMMENDED, process_quietly
from floatref_conformance.devices.interface import visible
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of
from floatref_conformance.selftest.grading import NOMINAL

COEFFICIENTS = 0, 3, 4.5, 6, 7.5, 9, 12
PIPELINE, SLIP = "pipeline", "slip {:g} %/g"
Profiler = Callable[[Taken], Profile]
Row = dict[str, Any]


def pipeline(taken: Taken) -> Profile:
    """Return the profile of the default pipeline."""
    return process_quietly(taken.recording, RECOMMENDED)


def along_encoder(taken: Taken, slip_per_g: float) -> Profile:
    """Return the road without any error, on an axis corrected for ``slip_per_g``."""
    axis = EncoderAxis.of(taken)
    speed = drive_of(taken.scenario).motion(taken.recording.channel("distance").times_s).speed
    counted_m = slip_per_g * (speed**2 - speed[0] ** 2) / (2 * STANDARD_GRAVITY)
    corrected = replace(axis, encoder_m=axis.encoder_m - counted_m)
    return corrected.place(filter_truth(taken.truth))


PROFILERS: dict[str, Profiler] = {
    PIPELINE: pipeline,
    **{SLIP.format(c): partial(along_encoder, slip_per_g=c / 100) for c in COEFFICIENTS},
}


@dataclass
class Bench:
    """Delivers what one profiler makes of a simulated recording."""

    profiler: Profiler

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording, with the channels of nominal sensors."""
        taken = make_taken(restrict_channels(NOMINAL, scenario))
        return replace(taken, recording=visible(taken.recording, NOMINAL.channels))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return the profile."""
        return self.profiler(taken)


def judge(task: tuple[int, str]) -> list[Row]:
    """Return what each profiler fails in the seeded cases of one check, and by how much."""
    seed, check_id = task
    check = driving_checks(find_edition())[check_id]
    cases = check.cases(seed, Effort.QUICK)
    each = ((case, name) for case in cases for name in PROFILERS)
    return [
        {"seed": seed, "check": check_id, "case": case.name, "profiler": name}
        | fails_of(check, case, PROFILERS[name])
        for case, name in each
    ]


def fails_of(check: DrivingCheck, case: Case, profiler: Profiler) -> Row:
    """Return the quantities that a profiler fails in a case, with how far they are off."""
    found = check.judge(case, Bench(profiler))
    failed = [m for m in found if not m.within(DeviceClass.ADEQUATE)]
    most = {m.quantity: 0.0 for m in failed}
    for m in failed:
        most[m.quantity] = max(most[m.quantity], m.ratio(DeviceClass.ADEQUATE))
    return {"fails": most}


COLUMNS = "check", "pipeline", "the most", *(f"{c:g} % per g" for c in COEFFICIENTS), "every c"


def summarise(rows: list[Row]) -> Iterator[list[str]]:
    """Give with how many seeds the pipeline, and each perfect profile, fail every check."""
    for check in dict.fromkeys(row["check"] for row in rows):
        own = [row for row in rows if row["check"] == check]
        slips = [_seeds(own, SLIP.format(c)) for c in COEFFICIENTS]
        counts = [str(len(seeds)) for seeds in (*slips, set.intersection(*slips))]
        yield [check, str(len(_seeds(own, PIPELINE))), _most(own), *counts]


def _seeds(rows: list[Row], profiler: str) -> set[int]:
    """Return the seeds with which a profiler fails a case of ``rows``."""
    return {row["seed"] for row in rows if row["profiler"] == profiler and row["fails"]}


def _most(rows: list[Row]) -> str:
    """Return the quantity that the pipeline fails by the most."""
    own = [row["fails"] for row in rows if row["profiler"] == PIPELINE]
    all_of = [(times, quantity) for fails in own for quantity, times in fails.items()]
    return "{1}, {0:.1f} × the limit".format(*max(all_of)) if all_of else ""


def main() -> None:
    """Judge, and print with which seeds each check fails."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--json", type=Path, help="write all figures there")
    given = parser.parse_args()
    tasks = [(seed, id_) for seed in range(given.seeds) for id_ in driving_checks(find_edition())]
    with ProcessPoolExecutor(given.jobs, get_context("spawn")) as pool:
        work = track(pool.map(judge, tasks), "Judging", total=len(tasks))
        rows = [row for part in work for row in part]
    if given.json:
        given.json.write_text(json.dumps(rows, indent=1), encoding="utf-8")
    show("Seeds with which each fails", COLUMNS, list(summarise(rows)), 150)


if __name__ == "__main__":
    main()
