"""`floatref plot`: a picture of a stored profile, or of raw channels of a recording."""

from dataclasses import replace
from pathlib import Path

import click

from floatref.cli.look.look_sources import (
    check_out,
    is_recording,
    look_options,
    refuse_channels,
)
from floatref.cli.recordings.recording_options import RecordingReader
from floatref.engine.formats import profile_of
from floatref.files.sources import name_errors
from floatref.values.display.short_text import join_some
from floatref.values.parts.windows import (
    Window,
    choose_channels,
    cut_profile,
    cut_recording,
    first_time,
)


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
    from floatref.plots import check_drawing

    check_out(out, [source], overwrite)
    check_drawing(out)
    window, reading = Window(begin, end), RecordingReader(adapter, channel_map)
    if is_recording(source, reading):
        drawn = _draw_recording(source, out, reading, window, channels, units, title)
    else:
        refuse_channels(channels)
        drawn = _draw_profile(source, out, window, units, title)
    click.echo(f"{out}: {drawn}")


def _draw_profile(source: Path, out: Path, window: Window, units: str, title: str) -> str:
    """Draw the part of a profile in ``window`` to ``out``, and return which part that is."""
    from floatref.plots import save
    from floatref.plots.profile_figure import profile_figure

    read = profile_of(source)
    with name_errors(source):
        cut = cut_profile(read, window)
        figure = profile_figure(cut, units, title or None)
    save(figure, out)
    span = f"{cut.start_m:.1f} to {cut.start_m + cut.length_m:.1f} m"
    return f"{span}, {', '.join(cut)}"


def _draw_recording(
    source: Path,
    out: Path,
    reading: RecordingReader,
    window: Window,
    channels: tuple[str, ...],
    units: str,
    title: str,
) -> str:
    """Draw the chosen channels in ``window`` to ``out``, and return which these are."""
    from floatref.plots import save
    from floatref.plots.recording_figure import recording_figure

    read = reading.recording_at(source)
    with name_errors(source):
        chosen = replace(read, channels=choose_channels(read, channels))
        cut = cut_recording(chosen, window, first_time(read))
        figure = recording_figure(cut, units, title, first_time(read))
    save(figure, out)
    return join_some([str(channel.id) for channel in cut.channels])
