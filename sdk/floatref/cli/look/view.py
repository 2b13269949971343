"""`floatref view`: one HTML file of profiles, or of a recording, for any browser, offline."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from floatref.cli.look.look_sources import (
    check_out,
    is_recording,
    look_options,
    read_profiles,
    refuse_channels,
    refuse_without_recording,
)
from floatref.cli.recordings.recording_options import RecordingReader, beside
from floatref.errors import InputError
from floatref.files.sources import real_path
from floatref.values.parts.windows import Window
from floatref.viewer.page_file import PageOptions

SUFFIXES = (".html", ".htm")


@click.command("view")
@click.argument(
    "sources",
    nargs=-1,
    required=True,
    type=click.Path(path_type=Path),
    metavar="PROFILE...|RECORDING",
)
@click.option(
    "-o",
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="FILE.html",
    help="Where to write.",
)
@beside("Recording of the first PROFILE: adds time, speed, events and the map.")
@click.option(
    "--segment",
    "segment_m",
    type=float,
    default=100.0,
    show_default=True,
    metavar="METRES",
    help="Length of a segment of the IRI.",
)
@click.option(
    "--size",
    "most_mb",
    type=float,
    default=40.0,
    show_default=True,
    metavar="MB",
    help="Largest size of the file; a longer run is drawn in coarser bins.",
)
@look_options
def view(
    sources: tuple[Path, ...],
    out: Path,
    recording: Path | None,
    begin: float | None,
    end: float | None,
    channels: tuple[str, ...],
    overwrite: bool,
    adapter: str | None,
    channel_map: Path | None,
    **given: Any,
) -> None:
    """Write FILE.html, which shows profiles of one road, or a recording, in any browser.

    The first PROFILE is the reference of the others. --from and --to are distances in m for
    profiles, and seconds after the first sample for a recording; what lies between them is drawn
    down to every sample as far as --size allows.
    """
    options = PageOptions(window=Window(begin, end), overwrite=overwrite, **given)
    if out.suffix.lower() not in SUFFIXES:
        raise InputError(f"{out}: not the name of a page; end it with {' or '.join(SUFFIXES)}")
    check_out(out, [*sources, *filter(None, [recording])], overwrite)
    reading = RecordingReader(adapter, channel_map)
    if recording is None and len(sources) == 1 and is_recording(sources[0], reading):
        document = _view_recording(sources[0], out, options, channels, reading)
    else:
        refuse_channels(channels)
        document = _view_profiles(sources, out, options, recording, reading)
    samples, of = document["finest"]["samples"], document["finest"]["of"]
    finest = f"every one of the {of}" if samples == 1 else f"bins of {samples} {of} and coarser"
    click.echo(f"{out}: {out.stat().st_size / 1e6:.1f} MB, {finest}")


def _view_recording(
    source: Path, out: Path, options: PageOptions, channels: Sequence[str], reading: RecordingReader
) -> dict[str, Any]:
    from floatref.viewer import write_recording_page

    found = reading.recording_at(source)
    return write_recording_page(out, real_path(source).name, found, options, channels)


def _view_profiles(
    sources: Sequence[Path],
    out: Path,
    options: PageOptions,
    recording: Path | None,
    reading: RecordingReader,
) -> dict[str, Any]:
    from floatref.viewer import write_profile_page

    if recording is None:
        refuse_without_recording(reading)
    profiles = read_profiles(sources)
    found = None if recording is None else reading.recording_at(recording)
    return write_profile_page(out, profiles, options, found)
