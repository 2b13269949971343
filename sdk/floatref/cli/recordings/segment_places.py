"""`--gis` of commands that take a profile: its segments where the recording of it was."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import click

from floatref.cli.recordings.recording_options import (
    READING,
    RecordingReader,
    add_options,
    beside,
)
from floatref.errors import InputError
from floatref.measures.ride.segment_measures import RideLimits
from floatref.values.profile import Profile

F = TypeVar("F", bound=Callable[..., Any])


@dataclass(frozen=True)
class Layer:
    """A layer to write: its file, the recording that has the places, and how that is read."""

    path: Path
    recording: Path
    reading: RecordingReader


def layer_options(command: F) -> F:
    """Add the options of a layer to ``command``; it gets them as one argument, ``layer``."""
    options = (
        click.option(
            "--gis",
            type=click.Path(path_type=Path),
            metavar="FILE",
            help="Write the segments as lines to FILE.geojson or FILE.gpkg.",
        ),
        beside("For --gis: the recording that PROFILE was made of, which has the places."),
        *READING,
    )
    return add_options(command, options)


def layer_of(
    gis: Path | None,
    recording: Path | None,
    adapter: str | None,
    channel_map: Path | None,
    overwrite: bool,
) -> Layer | None:
    """Return the layer that the options ask for, None without `--gis`.

    Raises InputError for `--gis` without a recording, the other options without `--gis`, and for a
    file that could not be written later.
    """
    reading = RecordingReader(adapter, channel_map)
    if gis is None:
        if recording is not None or reading.is_stated or overwrite:
            raise InputError("--recording, --adapter, --map and --overwrite are for --gis FILE")
        return None
    from floatref.files.gis.layer import check_layer

    if recording is None:
        raise InputError("--gis needs the places of a recording; give --recording RECORDING")
    check_layer(gis, overwrite)
    return Layer(gis, recording, reading)


def write_profile_layer(
    profile: Profile,
    name: str,
    segment_m: float | None,
    layer: Layer,
    limits: RideLimits | None = None,
) -> None:
    """Write the segments of ``profile``, which is called ``name``, and print how many they are.

    With ``limits`` they have the measures of ride too. Raises InputError for a recording that
    cannot be used, has no places, or is not the one that the profile was made of.
    """
    from floatref.batch.results.positions import is_located
    from floatref.batch.results.segment_layer import features_of, layer_columns
    from floatref.batch.results.segments import measure_segments
    from floatref.files.gis.layer import write_layer

    read = layer.reading.source_at(layer.recording)
    if not is_located(read.recording):
        raise InputError(
            f"{layer.recording}: no channels gnss_latitude and gnss_longitude; "
            "segments have no place without them"
        )
    _check_same(profile, read.origin["sha256"], layer.recording)
    rows, remarks = measure_segments(profile, segment_m, read.recording, limits is not None, limits)
    for line in remarks:
        click.echo(f"Warning: {line}", err=True)
    columns = layer_columns(limits is not None)
    # The target was checked before, and may have been meant to be replaced.
    count = write_layer(features_of(name, rows), columns, layer.path, overwrite=True)
    click.echo(f"{layer.path}: {count}", err=True)


def _check_same(profile: Profile, hashes: dict[str, str], recording: Path) -> None:
    """Raise InputError if ``profile`` states other inputs than those with ``hashes``."""
    stated = profile.provenance.get("sha256")
    if isinstance(stated, dict) and set(stated.values()) != set(hashes.values()):
        raise InputError(
            f"{recording}: its SHA-256 is not the one that the profile states; give the "
            "recording that the profile was made of"
        )
