"""`floatref allan`: the noise of sensors at rest, and settings from it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

import click

from floatref.cli.allan.allan_report import (
    allan_report,
    check_noise,
    check_stationary,
    choose_channels,
)
from floatref.cli.allan.allan_tables import print_tables
from floatref.cli.printing import print_json
from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_file
from floatref.files.document import write_document
from floatref.files.sources import name_errors
from floatref.mapping.sources import recording_of
from floatref.measures.allan.at_rest import ChannelNoise, channel_noise
from floatref.values.recording import Channel, Recording


@click.command("allan")
@click.argument("recording", type=click.Path(path_type=Path))
@click.option("--adapter", metavar="NAME", help="Read RECORDING with this adapter.")
@click.option(
    "--channel", "names", multiple=True, metavar="NAME", help="Only this one; can be repeated."
)
@click.option(
    "--between",
    nargs=2,
    type=float,
    metavar="FROM TO",
    help="Fit to these cluster times alone, in s.",
)
@click.option(
    "--settings", type=click.Path(path_type=Path), metavar="FILE.json", help="Write settings there."
)
@click.option("--overwrite", is_flag=True, help="Replace existing settings.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE.png", help="Draw it too.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def allan(
    recording: Path,
    adapter: str | None,
    names: tuple[str, ...],
    between: tuple[float, float] | None,
    settings: Path | None,
    overwrite: bool,
    plot: Path | None,
    as_json: bool,
) -> None:
    """Print the Allan deviation and the noise coefficients of RECORDING, taken at rest.

    Densities and random walks of accelerometers and gyros are settings of the Kalman pipelines;
    `floatref process --settings` reads the file that --settings writes.
    """
    _check_targets(settings, overwrite, plot)
    read = recording_of(recording, adapter).recording
    with name_errors(recording):
        found, warnings = _analyse(read, names, between, quiet=as_json)
        report = allan_report(found, warnings)
        if settings is not None and not report["settings"]:
            raise InputError("gives no setting; record accelerometers and gyros, for longer")
    with _draw(found, plot):
        if settings is not None:
            with replace_file(settings, overwrite) as beside:
                write_document(report["settings"], beside)
    print_json(report) if as_json else print_tables(found, warnings)


def _check_targets(settings: Path | None, overwrite: bool, plot: Path | None) -> None:
    """Raise InputError now for a target to which writing would fail later."""
    if settings is not None:
        check_target(settings, overwrite)
    if plot is not None:
        from floatref.plots import check_drawing

        check_target(plot, overwrite=True)
        check_drawing(plot)


def _analyse(
    recording: Recording, names: tuple[str, ...], between: tuple[float, float] | None, quiet: bool
) -> tuple[list[ChannelNoise], list[str]]:
    """Return the noise of every usable channel, and warnings.

    An unusable channel gives a warning, or an InputError if it was named or is the only one.
    """
    channels, found, warnings = (
        choose_channels(recording, names),
        [],
        list(check_stationary(recording)),
    )
    for channel, progress in _show_progress(channels, quiet):
        try:
            noise = channel_noise(channel, between, progress)
        except InputError as error:
            if names or len(channels) == 1:
                raise
            warnings.append(f"{error}; not analysed")
            continue
        found.append(noise)
        warnings.extend(check_noise(noise, channel))
    if not found:
        raise InputError(f"no channel can be used: {warnings[-1]}")
    return found, warnings


def _show_progress(
    channels: tuple[Channel, ...], quiet: bool
) -> Iterator[tuple[Channel, Callable[[float], None]]]:
    """Yield every channel and a function to report its progress, under a bar on a terminal."""
    from rich.console import Console
    from rich.progress import Progress

    console = Console(stderr=True)
    total = sum(channel.values.size for channel in channels)
    shown = console.is_terminal and not quiet
    with Progress(console=console, transient=True) if shown else nullcontext() as bar:
        task = bar.add_task("Averaging", total=total) if bar else None
        done = 0
        for channel in channels:

            def tell(share: float, size: int = channel.values.size, before: int = done) -> None:
                if bar and task is not None:
                    bar.update(task, completed=before + share * size)

            yield channel, tell
            done += channel.values.size


@contextmanager
def _draw(found: list[ChannelNoise], plot: Path | None) -> Iterator[None]:
    """Draw beside ``plot``; the drawing gets its name after everything else is written."""
    if plot is None:
        yield
        return
    from floatref.plots import draw_allan

    with replace_file(plot, overwrite=True) as beside:
        draw_allan(found, beside)
        yield
