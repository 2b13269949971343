"""`conformance certify`: judge a profiler from its recorded runs."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref_conformance.certify.plan.plan_document import Plan, Processing
from floatref_conformance.certify.practice.practice_document import DEFAULT
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli.certify.certify_options import Limit, limits_with, plan_of

if TYPE_CHECKING:
    from floatref_conformance.certify.judging.contents import Worksheet
    from floatref_conformance.certify.judging.limits import CertificationLimits

FILE = click.Path(exists=True, dir_okay=False, path_type=Path)
CORRELATION, OPTIONAL = Limit(most=1.0), Limit(optional=True)


@click.command()
@click.argument("runs", metavar="[RUN]...", nargs=-1)
@click.option("--reference", metavar="PROFILE", help="Reference profile, of any format.")
@click.option("--reference-is-run", is_flag=True, help="The reference is another run, no truth.")
@click.option(
    "--section",
    "sections",
    metavar="FROM:TO[:NAME]",
    multiple=True,
    help="Part of the reference in m; may be repeated.  [default: all of it]",
)
@click.option("--quiescent", metavar="SRC[@FROM:TO]", help="Recorded with the vehicle at rest.")
@click.option("--bounce", metavar="SRC[@FROM:TO]", help="Recorded with the body pushed.")
@click.option(
    "--plan", metavar="FILE.toml", type=FILE, help="A file with all this for several sections."
)
@click.option(
    "--practice",
    metavar="NAME|FILE.json",
    default=DEFAULT,
    show_default=True,
    help="Practice whose limits decide; `conformance practices` lists ours.",
)
@click.option(
    "--class",
    "device_class",
    type=click.Choice([c.value for c in DeviceClass]),
    default=DeviceClass.NOMINAL.value,
    show_default=True,
    help="Class whose limits decide; nominal has those of the practice itself.",
)
@click.option("--pipeline", metavar="NAME", help="Of `floatref process`, for recordings.")
@click.option("--settings", metavar="FILE", type=FILE, help="JSON file of the pipeline's settings.")
@click.option("--adapter", metavar="NAME", help="Read recordings with this adapter.")
@click.option(
    "--map", "channel_map", metavar="FILE.toml", type=FILE, help="Channel map of native files."
)
@click.option("--runs", "least_runs", metavar="N", type=click.IntRange(min=1), help="At least.")
@click.option("--min-repeatability", "repeatability", metavar="X", type=CORRELATION)
@click.option("--min-accuracy", "accuracy", metavar="X", type=CORRELATION)
@click.option("--max-distance-error", "distance_percent", metavar="PERCENT", type=OPTIONAL)
@click.option("--max-height-error", "height_percent", metavar="PERCENT", type=OPTIONAL)
@click.option("--max-iri-bias", "iri_bias_percent", metavar="PERCENT", type=OPTIONAL)
@click.option("--max-long-wave-error", "long_wave_percent", metavar="PERCENT", type=OPTIONAL)
@click.option("--max-quiescent", "quiescent_m_per_km", metavar="M/KM", type=Limit())
@click.option("--max-bounce", "bounce_m_per_km", metavar="M/KM", type=Limit())
@click.option(
    "--report",
    metavar="DIR",
    type=click.Path(path_type=Path),
    help="New folder for worksheet.json, worksheet.html and the profiles that were compared.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object, the worksheet.")
@click.pass_context
def certify(
    context: click.Context,
    /,
    runs: tuple[str, ...],
    reference: str | None,
    reference_is_run: bool,
    sections: tuple[str, ...],
    quiescent: str | None,
    bounce: str | None,
    plan: Path | None,
    practice: str,
    device_class: str,
    pipeline: str | None,
    settings: Path | None,
    adapter: str | None,
    channel_map: Path | None,
    least_runs: int | None,
    report: Path | None,
    as_json: bool,
    **given: Any,
) -> None:
    """Judge a profiler from repeated runs over test sections, as AASHTO R 56 does.

    RUN is a profile of any format, a recording, which is processed on the way, a directory of
    them, or a pattern. Runs that start elsewhere, go the other way or are in other units are
    recognised. --max-distance-error, --max-height-error, --max-iri-bias and --max-long-wave-error
    also take the word none: then the error is reported and not judged.

    Exit code 0: PASS; 1: FAIL; 2: wrong usage, or a reference or runs that cannot be used; 3: the
    suite itself is at fault, no worksheet; 4: INCOMPLETE, such as too few runs.
    """
    asked = plan_of(runs, reference, sections, plan, quiescent, bounce)
    limits = limits_with(DeviceClass(device_class), {**given, "runs": least_runs}, practice)
    _check_pipeline(pipeline)
    _check_report(report)
    processing = Processing(pipeline, settings, adapter, channel_map, reference_is_run)
    worksheet = _certify_with_progress(asked, processing, limits, DeviceClass(device_class))
    if report is not None:
        _write(worksheet, report)
    _show(worksheet, as_json)
    context.exit(worksheet.verdict.exit_code)


def _check_pipeline(name: str | None) -> None:
    """Raise InputError now for a pipeline that every recording would be refused for."""
    if name is None:
        return
    from floatref_conformance.devices.builtin import entries

    known = [entry.name for entry in entries()]
    if name not in known:
        raise InputError(f"pipeline {name}: unknown; {suggest(name, known)}")


def _check_report(folder: Path | None) -> None:
    """Raise InputError now for a report that could not be written after the work."""
    if folder is None:
        return
    from floatref_conformance.certify.worksheet.keeping import PAGE, check_report
    from floatref_conformance.render.text import needs_jinja

    needs_jinja(PAGE)
    check_report(folder)


def _certify_with_progress(
    plan: Plan, processing: Processing, limits: "CertificationLimits", device_class: DeviceClass
) -> "Worksheet":
    """Return the worksheet; on a terminal a bar on standard error shows the progress."""
    from rich.console import Console
    from rich.progress import Progress

    from floatref_conformance.certify.certifying import certify as certified

    console = Console(stderr=True)
    shown = console.is_terminal
    with Progress(console=console, transient=True, disable=not shown) as bar:
        task = bar.add_task("", total=1.0)
        return certified(
            plan,
            processing,
            limits,
            device_class,
            lambda doing, done: bar.update(task, description=doing, completed=done),
        )


def _write(worksheet: "Worksheet", folder: Path) -> None:
    from floatref_conformance.certify.worksheet.keeping import write_report
    from floatref_conformance.certify.worksheet.page import write_page
    from floatref_conformance.certify.worksheet.worksheet_document import write_worksheet

    write_report(worksheet, folder, write_worksheet, write_page)


def _show(worksheet: "Worksheet", as_json: bool) -> None:
    if as_json:
        from floatref_conformance.certify.worksheet.worksheet_document import as_json as document

        click.echo(json.dumps(document(worksheet), indent=2, allow_nan=False))
        return
    from floatref_conformance.certify.worksheet.terminal import print_worksheet
    from floatref_conformance.render.terminal import PipedConsole

    print_worksheet(worksheet, PipedConsole(emoji=False))
