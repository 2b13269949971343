"""`floatref tune`: noise settings of a Kalman pipeline, from preliminary runs of a known road."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from floatref.cli.printing import print_json
from floatref.cli.tune.tune_report import loss_curves, print_tables, tune_report
from floatref.engine.formats import profile_of
from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_file
from floatref.files.document import write_document
from floatref.files.settings_file import read_settings
from floatref.files.sources import real_path
from floatref.mapping.sources import recording_of
from floatref.values.profile import Profile
from floatref.values.recording import Recording

if TYPE_CHECKING:
    from floatref.tuning import Tuning


@click.command("tune")
@click.argument(
    "recordings",
    metavar="RECORDING...",
    nargs=-1,
    required=True,
    type=click.Path(path_type=Path),
)
@click.option(
    "--reference",
    required=True,
    type=click.Path(path_type=Path),
    metavar="PROFILE",
    help="Profile of the road of all runs, on the same axis of distance.",
)
@click.option(
    "-o",
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="FILE.json",
    help="Where to write the settings.",
)
@click.option("--pipeline", default="kalman-smoother-reflection", show_default=True, metavar="NAME")
@click.option(
    "--settings",
    type=click.Path(path_type=Path),
    metavar="FILE.json",
    help="Settings that stay fixed, and initial values.",
)
@click.option("--adapter", metavar="NAME", help="Read every RECORDING with this adapter.")
@click.option(
    "--max-offset",
    "max_offset_m",
    type=click.FloatRange(min=0.0),
    default=1.0,
    show_default=True,
    metavar="METRES",
    help="Largest offset searched.",
)
@click.option("--overwrite", is_flag=True, help="Replace an existing target.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE.png", help="Draw it too.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def tune(
    recordings: tuple[Path, ...],
    reference: Path,
    out: Path,
    pipeline: str,
    settings: Path | None,
    adapter: str | None,
    max_offset_m: float,
    overwrite: bool,
    plot: Path | None,
    as_json: bool,
) -> None:
    """Tune the noise of the accelerations and the rates to runs whose road profile is known.

    Follows section 6.4.4 of the dissertation: first no loss at high speed, then braking, stops and
    low speed. Runs are classified by their encoders. `floatref process --settings` reads the
    result.
    """
    _check_targets(out, plot, overwrite)
    given = read_settings(settings)
    expected = profile_of(reference)
    runs = _read(recordings, adapter)
    tuning = _tune(runs, expected, pipeline, given, max_offset_m, quiet=as_json)
    with _draw(tuning, plot), replace_file(out, overwrite) as beside:
        write_document(tuning.settings, beside)
    print_json(tune_report(tuning, out)) if as_json else print_tables(tuning, out)


def _check_targets(out: Path, plot: Path | None, overwrite: bool) -> None:
    """Raise InputError now for a target to which writing would fail later."""
    check_target(out, overwrite)
    if out.is_dir():
        raise InputError(f"{out}: is a folder; give the name of a file to write")
    if plot is None:
        return
    if real_path(plot) == real_path(out):
        raise InputError(f"{plot}: is the settings' own name; choose another for the drawing")
    from floatref.plots import check_drawing

    check_target(plot, overwrite=True)
    check_drawing(plot)


def _read(sources: tuple[Path, ...], adapter: str | None) -> dict[str, Recording]:
    """Return the recordings by the shortest names that are distinct."""
    short = [real_path(source).name for source in sources]
    names = short if len(set(short)) == len(short) else [str(source) for source in sources]
    places = [real_path(source) for source in sources]
    for source, place in zip(sources, places, strict=True):
        if places.count(place) > 1:
            raise InputError(f"{source}: given twice; give every run once")
    return {
        name: recording_of(source, adapter).recording
        for name, source in zip(names, sources, strict=True)
    }


def _tune(
    runs: Mapping[str, Recording],
    reference: Profile,
    pipeline: str,
    given: Mapping[str, Any],
    max_offset_m: float,
    quiet: bool,
) -> "Tuning":
    from floatref.tuning import tune as tuned

    with _show_progress(quiet) as (tell, done):
        return tuned(runs, reference, pipeline, given, max_offset_m, tell, done)


@contextmanager
def _show_progress(quiet: bool) -> Iterator[tuple[Callable[[str], None], Callable[[int], None]]]:
    """Yield functions to report steps and profiles, which a terminal shows at once."""
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        TextColumn("{task.completed:.0f} profiles"),
        TimeElapsedColumn(),
    )
    shown = console.is_terminal and not quiet
    with Progress(*columns, console=console, transient=True) if shown else nullcontext() as bar:
        task = bar.add_task("Preparation", total=None) if bar else None

        def tell(step: str) -> None:
            if bar and task is not None:
                bar.update(task, description=step)

        def done(profiles: int) -> None:
            if bar and task is not None:
                bar.update(task, completed=profiles)

        yield tell, done


@contextmanager
def _draw(tuning: "Tuning", plot: Path | None) -> Iterator[None]:
    """Draw beside ``plot``; the drawing gets its name after everything else is written."""
    if plot is None:
        yield
        return
    from floatref.plots import draw_sensitivity

    with replace_file(plot, overwrite=True) as beside:
        draw_sensitivity(loss_curves(tuning), beside)
        yield
