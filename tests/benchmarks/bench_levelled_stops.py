"""What `LevelByRoad` is worth: drawn stops with it and without, as `conformance table` has them.

`road-prior-smoother` is the pipeline with the stage; a plug-in has the same with `HeightByModel`
in its place, which carries the heights alone.

    python tests/benchmarks/bench_levelled_stops.py --drives 65 --jobs 2 --json stops.json
"""

import argparse
import json
import warnings
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from rich.console import Console
from rich.progress import track

import floatref
from floatref.engine.plugins import plugins
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.table.families.conditions import STOPS, STOPS_FAMILY
from floatref_conformance.table.families.family_document import family_document
from floatref_conformance.table.families.family_making import score_profile, wheel_paths
from floatref_conformance.table.families.family_settings import FamilySettings, draw_drive
from floatref_conformance.table.families.family_table import FamilyTable
from floatref_conformance.table.families.family_text import print_families
from floatref_conformance.table.passes import encoder_along_truth

BASE, UNLEVELLED = "road-prior-smoother", "road-prior-unlevelled"


def carry(context):
    """Carry heights by a modelled pitch, and leave forces as they are."""
    setup, tracks = context.header.setup, context.header.tracks
    levers_m = {name: setup.track(name).laser_offset_m[0] for name in tracks}
    return (floatref.make_stage("HeightByModel", levers_m),) if any(levers_m.values()) else ()


class Unlevelled:
    """The plug-in."""

    @floatref.hookimpl
    def floatref_register_pipelines(self, register):
        """Add the road prior without levelled forces."""
        base = floatref.pipeline(BASE)
        register(base.with_answers(name=UNLEVELLED, summary="unlevelled", temporal_laser=carry))


def add_plugin():
    """Load the plug-in, in every process."""
    plugins().add(Unlevelled(), "unlevelled")


def drive(task):
    """Return the scores of one drive, simulated, processed and compared with its truth."""
    pipeline, seed, condition, number = task
    scenario = draw_drive(seed, STOPS[condition], number, frozenset())
    simulation = simulate(scenario)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        profile = floatref.process(simulation.recording, pipeline)
    encoder_m = encoder_along_truth(simulation)
    return score_profile(scenario, simulation.truth, encoder_m, profile)


def main():
    """Drive, and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--drives", type=int, default=10, help="of each shape")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--pipeline", nargs="+", default=(BASE, UNLEVELLED))
    parser.add_argument("--json", type=Path, help="write the table there")
    given = parser.parse_args()
    add_plugin()
    names, shapes = tuple(given.pipeline), range(len(STOPS))
    tasks = [(p, given.seed, c, n) for p in names for n in range(given.drives) for c in shapes]
    settings = FamilySettings(STOPS_FAMILY, given.seed, given.drives, names)
    table = FamilyTable(settings)
    workers = ProcessPoolExecutor(given.jobs, get_context("spawn"), initializer=add_plugin)
    with workers as pool:
        scores = track(pool.map(drive, tasks), "Driving", total=len(tasks))
        for (name, seed, c, n), scored in zip(tasks, scores, strict=True):
            scenario = draw_drive(seed, STOPS[c], n, frozenset())
            table.paths += wheel_paths(name, STOPS[c], scenario, scored)
    print_families(table, Console(width=150, emoji=False))
    if given.json:
        text = json.dumps(family_document(table), indent=1, allow_nan=False)
        given.json.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
