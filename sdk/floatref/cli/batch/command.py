"""`floatref batch`: many recordings into profiles and one summary, on a Dask cluster."""

from collections.abc import Sequence
from pathlib import Path

import click

from floatref.batch.jobs.defaults import Defaults
from floatref.batch.jobs.inputs import find_jobs
from floatref.batch.jobs.job import Job
from floatref.batch.results.folder import count_recorded
from floatref.batch.results.totals import Tally
from floatref.batch.work.cluster import check_installed
from floatref.batch.work.encryption import check_encrypted
from floatref.cli.batch.batch_report import print_report
from floatref.cli.batch.batch_work import Work, work_through
from floatref.cli.batch.interruption import interruptible
from floatref.cli.printing import print_json
from floatref.engine.choosing import AUTO
from floatref.errors import InputError
from floatref.files.atomic import check_target
from floatref.files.gis.layer import check_layer
from floatref.files.settings_file import read_settings

SOME_FAILED = 5
"""Exit code if there is a file without a profile."""


@click.command("batch")
@click.argument("given", metavar="IN...", nargs=-1, required=True)
@click.option(
    "-o",
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Where to write; a new or empty folder.",
)
@click.option("--adapter", metavar="NAME", help="Read every file with this adapter.")
@click.option(
    "--map",
    "channel_map",
    type=click.Path(path_type=Path),
    metavar="FILE.toml",
    help="Channel map of the native files.",
)
@click.option("--pipeline", default=AUTO, show_default=True, metavar="NAME")
@click.option("--settings", type=click.Path(path_type=Path), help="JSON file of settings.")
@click.option(
    "--segment",
    "segment_m",
    type=float,
    metavar="METRES",
    help="Length of a segment in the summary; by default the whole profile is one.",
)
@click.option(
    "--measures",
    is_flag=True,
    help="Add Ride Number, localized roughness, straightedge and others to every segment, by the "
    "default limits of roughness and straightedge.",
)
@click.option(
    "--gis",
    type=click.Path(path_type=Path),
    multiple=True,
    metavar="FILE",
    help="Write the segments as lines to FILE.geojson or FILE.gpkg; can be repeated.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="Workers on this machine; by default one per processor.",
)
@click.option("--cluster", metavar="URL", help="Address of a Dask scheduler, as tls://HOST:8786.")
@click.option(
    "--unencrypted-cluster",
    "unencrypted",
    is_flag=True,
    help="Allow --cluster without TLS beyond this machine: whoever reaches it can run programs.",
)
@click.option(
    "--resume",
    is_flag=True,
    help="Continue in DIR; do not repeat files that are done and unchanged.",
)
@click.option(
    "--plot", type=click.Path(path_type=Path), metavar="FILE.png", help="Draw the summary too."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def batch(
    given: tuple[str, ...],
    out: Path,
    adapter: str | None,
    channel_map: Path | None,
    pipeline: str,
    settings: Path | None,
    segment_m: float | None,
    measures: bool,
    gis: tuple[Path, ...],
    jobs: int | None,
    cluster: str | None,
    unencrypted: bool,
    resume: bool,
    plot: Path | None,
    as_json: bool,
) -> None:
    """Turn every recording of IN... into a road profile, and all of them into one summary.

    IN is a recording, a native file, a folder of them, a glob in quotes, or a manifest: a text
    file with one path a line, or a CSV table with a column file. A file that cannot be used is a
    row of the summary, and the exit code is 5.
    """
    if jobs and cluster:
        raise InputError("--jobs is for workers of this machine; omit it or --cluster")
    if cluster:
        check_encrypted(cluster, unencrypted)
    tally, begun = Tally(), list[Job]()
    with interruptible(lambda: _describe_interruption(begun)):
        check_installed()
        _check_drawing(plot, out)
        _check_layers(gis, out)
        chosen = read_settings(settings)
        defaults = Defaults(adapter, channel_map, pipeline, chosen, segment_m, measures)
        found = find_jobs(given, out, defaults)
        begun += found.jobs
        work = Work(given, defaults, out, resume, jobs, cluster, plot, gis, unencrypted)
        report = work_through(found, work, tally)
    print_json(report) if as_json else print_report(report, tally, out)
    if tally.failed:
        raise click.exceptions.Exit(SOME_FAILED)


def _check_layers(layers: tuple[Path, ...], out: Path) -> None:
    """Raise InputError now if a layer could not be written later; ``out`` may not exist yet."""
    for layer in layers:
        within = layer.absolute().parent == out.absolute()
        check_layer(layer, overwrite=True, in_new_folder=within)


def _check_drawing(plot: Path | None, out: Path) -> None:
    """Raise InputError now if drawing would fail later; ``out`` may not exist yet."""
    if plot is None:
        return
    from floatref.plots import check_drawing

    if plot.absolute().parent != out.absolute():
        check_target(plot, overwrite=True)
    check_drawing(plot)


def _describe_interruption(jobs: Sequence[Job]) -> str:
    """Return one line on the number of ``jobs`` that have a result on disk.

    Workers write it before the command hears of it, so the command's own count is late.
    """
    count = count_recorded(jobs)
    if not count:
        return "Interrupted before any file was done"
    return (
        f"Interrupted: {count} of {len(jobs)} files have a result; the same command with "
        "--resume goes on"
    )
