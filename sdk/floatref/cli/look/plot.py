"""`floatref plot`: a picture of a stored profile, or of raw channels of a recording."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from floatref.cli.look.sources import (
    Reading,
    check_out,
    is_recording,
    look_options,
    refuse_channels,
)
from floatref.engine.formats import profile_of
from floatref.files.sources import name_errors
from floatref.values.display.short_text import join_some
from floatref.values.windows import (
    Window,
    choose_channels,
    cut_profile,
    cut_recording,
    first_time,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@click.command("plot")
@click.argument("source", type=click.Path(path_type=Path), metavar="PROFILE|RECORDING")
@click.option(
    "-o",
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Where to write: .png, .svg or .pdf.",
)
@look_options
def plot(
    source: Path,
    out: Path,
    begin: float | None,
    end: float | None,
    units: str,
    title: str,
    channels: tuple[str, ...],
    adapter: str | None,
    channel_map: Path | None,
    overwrite: bool,
) -> None:
    """Draw PROFILE, or the channels of RECORDING, to FILE.

    --from and --to are distances in m for a profile, and seconds after the first sample for a
    recording. All figures are those of the part that is drawn.
    """
    from floatref.plots import check_drawing, save

    check_out(out, [source], overwrite)
    check_drawing(out)
    window, reading = Window(begin, end), Reading(adapter, channel_map)
    if is_recording(source, reading):
        figure, drawn = _of_recording(source, reading, window, channels, units, title)
    else:
        refuse_channels(channels)
        figure, drawn = _of_profile(source, window, units, title)
    save(figure, out)
    click.echo(f"{out}: {drawn}")


def _of_profile(source: Path, window: Window, units: str, title: str) -> tuple["Figure", str]:
    """Return the figure of the part of a profile in ``window``, and which part that is."""
    from floatref.plots.profile_figure import profile_figure

    read = profile_of(source)
    with name_errors(source):
        cut = cut_profile(read, window)
        span = f"{cut.start_m:.1f} to {cut.start_m + cut.length_m:.1f} m"
        return profile_figure(cut, units, title or None), f"{span}, {', '.join(cut)}"


def _of_recording(
    source: Path,
    reading: Reading,
    window: Window,
    channels: tuple[str, ...],
    units: str,
    title: str,
) -> tuple["Figure", str]:
    """Return the figure of the chosen channels in ``window``, and which these are."""
    from floatref.plots.recording_figure import recording_figure

    read = reading.recording_at(source)
    with name_errors(source):
        chosen = replace(read, channels=choose_channels(read, channels))
        cut = cut_recording(chosen, window, first_time(read))
        names = join_some([str(channel.id) for channel in cut.channels])
        return recording_figure(cut, units, title, first_time(read)), names
