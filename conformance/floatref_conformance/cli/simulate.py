"""`conformance simulate`: a run or a scenario file becomes a recording directory."""

import shutil
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from floatref.errors import InputError

if TYPE_CHECKING:
    from floatref_conformance.proving_ground.scenario import Scenario


@click.command()
@click.argument("run")
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Recording directory.")
@click.option("--seed", type=click.IntRange(min=0), help="Draws road and errors [default: 0].")
@click.option("--truth", type=click.Path(path_type=Path), help="Profile directory of the truth.")
def simulate(run: str, out: Path, seed: int | None, truth: Path | None) -> None:
    """Simulate RUN and write a recording directory.

    RUN is a published run (sg_10.7s_0.20g, …), ref_72 for the reference pass at 72 km/h, or a
    scenario file in JSON. The truth is the unfiltered elevation along the laser's path.
    """
    scenario = _scenario(run, seed)
    _check_targets(out, truth)
    from floatref.files import write_profile, write_recording
    from floatref.files.sources import name_errors
    from floatref_conformance.proving_ground.simulate import simulate as simulated

    click.echo(f"simulating {run}, seed {scenario.seed} …", err=True)
    with name_errors(run):
        simulation = simulated(scenario)
    click.echo("writing …", err=True)
    write_recording(simulation.recording, out)
    if truth is not None:
        try:
            write_profile(simulation.truth, truth)
        except BaseException:
            shutil.rmtree(out, ignore_errors=True)
            raise
    drive = simulation.motion
    click.echo(f"{out}: {drive.times_s[-1]:.1f} s, {drive.distance[-1]:.1f} m, tracks ", nl=False)
    click.echo(", ".join(scenario.tracks))


def _scenario(run: str, seed: int | None) -> "Scenario":
    """Return the scenario of a run's name or of a file, with its seed replaced if given."""
    from floatref_conformance.proving_ground.drives.runs import RUNS
    from floatref_conformance.proving_ground.scenario import read_scenario, scenario_of_run

    is_file = run not in RUNS and (run.endswith(".json") or Path(run).is_file())
    scenario = read_scenario(Path(run)) if is_file else scenario_of_run(run)
    return scenario if seed is None else replace(scenario, seed=seed)


def _check_targets(out: Path, truth: Path | None) -> None:
    """Raise InputError before any work for targets that cannot be written."""
    for target in (out, truth):
        if target is None:
            continue
        if target.exists() or target.is_symlink():
            raise InputError(f"{target}: exists; choose another name")
        if not target.resolve().parent.is_dir():
            raise InputError(f"{target}: its folder does not exist; make it first")
    if truth is not None and truth.resolve() == out.resolve():
        raise InputError(f"{truth}: is the recording's own folder; choose another")
