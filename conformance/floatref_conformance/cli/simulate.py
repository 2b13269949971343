"""`conformance simulate`: a run or a scenario file becomes a recording directory."""

import shutil
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from floatref.errors import InputError, TargetExists
from floatref.files.sources import real_path

if TYPE_CHECKING:
    from floatref_conformance.proving_ground.scenario import Scenario


@click.command()
@click.argument("run")
@click.option(
    "-o", "--out", required=True, type=click.Path(path_type=Path), help="Recording directory."
)
@click.option("--seed", type=click.IntRange(min=0), help="Draws road and errors [default: 0].")
@click.option("--truth", type=click.Path(path_type=Path), help="Profile directory of the truth.")
@click.option(
    "--runs",
    type=click.IntRange(1, 1000),
    help="Repeat passes of one road: OUT and the truth get a folder run_001, … for each.",
)
@click.option("--overwrite", is_flag=True, help="Replace an existing recording and truth.")
def simulate(
    run: str, out: Path, seed: int | None, truth: Path | None, runs: int | None, overwrite: bool
) -> None:
    """Simulate RUN and write a recording directory.

    RUN is a published run (sg_10.7s_0.20g, …), ref_72 for the reference pass at 72 km/h, or a
    scenario file in JSON (`conformance scenario` lists its keys). The truth is the unfiltered
    elevation along the laser's path.
    """
    from floatref_conformance.proving_ground.scenario import repeat_passes

    scenario = _scenario(run, seed)
    if overwrite and runs is not None:
        raise InputError("--overwrite: not together with --runs, whose old folders would remain")
    _check_targets(out, truth, overwrite)
    if overwrite:
        # Both are complete before the old ones go; nothing of them is taken away after an error.
        _write(run, scenario, out, truth, [], overwrite)
        return
    made: list[Path] = []
    try:
        if runs is None:
            _write(run, scenario, out, truth, made)
            return
        for number, each in enumerate(repeat_passes(scenario, runs), start=1):
            name = f"run_{number:03d}"
            _write(run, each, out / name, None if truth is None else truth / name, made)
    except BaseException:
        for folder in {*made, *((out, truth) if runs else ())} - {None}:
            shutil.rmtree(folder, ignore_errors=True)
        raise


def _write(
    run: str,
    scenario: "Scenario",
    out: Path,
    truth: Path | None,
    made: list[Path],
    overwrite: bool = False,
) -> None:
    """Simulate one pass; what was written is added to ``made``."""
    from floatref.files import write_profile, write_recording
    from floatref.files.sources import name_errors
    from floatref_conformance.proving_ground.simulate import simulate as simulated

    click.echo(f"simulating {run}, seed {scenario.seed} …", err=True)
    with name_errors(run):
        simulation = simulated(scenario)
    click.echo("writing …", err=True)
    for target in (out, truth):
        if target is not None:
            target.parent.mkdir(exist_ok=True)
    write_recording(simulation.recording, out, overwrite)
    made.append(out)
    if truth is not None:
        write_profile(simulation.truth, truth, overwrite)
        made.append(truth)
    drive = simulation.motion
    click.echo(f"{out}: {drive.times_s[-1]:.1f} s, {drive.distance[-1]:.1f} m, tracks ", nl=False)
    click.echo(", ".join(scenario.tracks))


def _scenario(run: str, seed: int | None) -> "Scenario":
    """Return the scenario of a run's name or of a file, with its seed replaced if given."""
    from floatref_conformance.proving_ground.drives.runs import RUNS
    from floatref_conformance.proving_ground.scenario import scenario_of_run
    from floatref_conformance.proving_ground.scenario_file import read_scenario

    is_file = run not in RUNS and (run.endswith(".json") or Path(run).is_file())
    scenario = read_scenario(Path(run)) if is_file else scenario_of_run(run)
    return scenario if seed is None else replace(scenario, seed=seed)


def _check_targets(out: Path, truth: Path | None, overwrite: bool) -> None:
    """Raise InputError before any work for targets that cannot be written."""
    for target in (out, truth):
        if target is None:
            continue
        if not overwrite and (target.exists() or target.is_symlink()):
            raise TargetExists(f"{target}: exists; choose another name")
        if not real_path(target).parent.is_dir():
            raise InputError(f"{target}: its folder does not exist; make it first")
    if truth is not None and real_path(truth) == real_path(out):
        raise InputError(f"{truth}: is the recording's own folder; choose another")
