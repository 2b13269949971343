"""`conformance faults`: faults in drives of known truth, and what every pipeline makes of them."""

import json
from pathlib import Path

import click

from floatref.errors import InputError
from floatref_conformance.faults.study import (
    DRIVES,
    NOMINAL_PIPELINES,
    NOMINAL_SENSORS,
    PIPELINES,
    Study,
    StudySettings,
)


@click.command()
@click.option(
    "--fault", "faults", metavar="NAME", multiple=True, help="This one alone; may be repeated."
)
@click.option(
    "--pipeline",
    "pipelines",
    metavar="NAME",
    multiple=True,
    help="This one alone; may be repeated.",
)
@click.option(
    "--drive",
    "drives",
    type=click.Choice(tuple(DRIVES)),
    multiple=True,
    help="This one alone; may be repeated.",
)
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    default=StudySettings.seed,
    show_default=True,
    help="Draws the random numbers of faults.",
)
@click.option(
    "--jobs", type=click.IntRange(min=1), default=1, show_default=True, help="Processes at a time."
)
@click.option("--nominal", is_flag=True, help="Record accelerometers, lasers and an encoder alone.")
@click.option(
    "-o", "--out", type=click.Path(path_type=Path), help="Also write the JSON object to FILE."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@click.option(
    "--clean",
    type=click.IntRange(min=0),
    default=0,
    show_default=True,
    help="Try this many healthy drives of the families in place of faults.",
)
@click.option("--list", "as_list", is_flag=True, help="List the faults, and try nothing.")
def faults(
    faults: tuple[str, ...],
    pipelines: tuple[str, ...],
    drives: tuple[str, ...],
    seed: int,
    jobs: int,
    nominal: bool,
    out: Path | None,
    as_json: bool,
    clean: int,
    as_list: bool,
) -> None:
    """Put faults of sensors into two drives, and try every pipeline on them.

    A trial ends as refused, right, flagged (what is wrong is not valid), warned of, or silently
    wrong: valid points with an IRI off by more than 5 % and 0.1 m/km, or a cross correlation below
    0.92, without any line about it. All of it takes some ten minutes on two free cores with --jobs
    2. With --clean, every refusal and every warning is a false alarm. The exit code is 0 whatever
    the figures are.
    """
    from floatref_conformance.faults.fault_list import FAULTS
    from floatref_conformance.faults.study import make_study
    from floatref_conformance.table.making import PassProgress

    if as_list:
        _print_list()
        return
    if clean:
        _try_clean(clean, seed, jobs, pipelines or PIPELINES)
        return
    if out is not None:
        from floatref.files.atomic import check_target

        check_target(out, overwrite=True)
        if out.is_dir():
            raise InputError(f"{out}: is a folder; give the name of a file to write")
    concerned = [f.name for f in FAULTS.values() if not nominal or f.sensor in NOMINAL_SENSORS]
    settings = StudySettings(
        faults or tuple(concerned),
        drives or tuple(DRIVES),
        pipelines or (NOMINAL_PIPELINES if nominal else PIPELINES),
        jobs,
        seed,
        nominal,
    )
    total = len(settings.drives) * (1 + len(settings.faults))
    with PassProgress(total) as progress:
        made = make_study(settings, progress)
    _show(made, as_json, out)


def _print_list() -> None:
    from floatref_conformance.faults.fault_list import FAULTS

    for fault in FAULTS.values():
        hidden = "; no recording can show it" if fault.twin else ""
        click.echo(f"{fault.name}: {fault.wrong}{hidden}")


def _try_clean(count: int, seed: int, jobs: int, pipelines: tuple[str, ...]) -> None:
    """Print the false alarms of ``count`` healthy drives."""
    from floatref_conformance.faults.clean_drives import try_clean_drives
    from floatref_conformance.table.making import PassProgress

    with PassProgress(count) as progress:
        made = try_clean_drives(count, seed, jobs, pipelines, progress)
    for alarm in made.alarms:
        what = "refused" if alarm.refused else "warned"
        click.echo(f"{what}: {alarm.drive}: {alarm.pipeline}: {alarm.line}")
    click.echo(f"False alarms: {made.alarmed} of {made.drives} healthy drives")


def _show(made: Study, as_json: bool, out: Path | None) -> None:
    from floatref.files.atomic import replace_file
    from floatref_conformance.faults.study_document import print_study, study_document
    from floatref_conformance.render.terminal import PipedConsole

    text = json.dumps(study_document(made), indent=2, allow_nan=False)
    if out is not None:
        with replace_file(out, overwrite=True) as beside:
            beside.write_text(text + "\n", encoding="utf-8")
    if as_json:
        click.echo(text)
    else:
        print_study(made, PipedConsole(emoji=False))
