"""`floatref process`: a recording, or a native file, into a road profile."""

from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from floatref.architectures.adapter import Adapter
from floatref.architectures.plugins import plugins
from floatref.cli.printing import number, print_json, print_settings, print_table
from floatref.errors import InputError
from floatref.files import fingerprint, write_profile, write_profile_csv
from floatref.files.atomic import check_target
from floatref.files.document import read_document
from floatref.files.sources import naming
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording

WRITERS = {"profile": write_profile, "csv": write_profile_csv}
SUFFIXES = {"": "profile", ".csv": "csv"}


@click.command("process")
@click.argument("source", type=click.Path(path_type=Path))
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Where to write.")
@click.option("--adapter", metavar="NAME", help="Read SOURCE with this adapter.")
@click.option("--pipeline", default="temporal-basic", show_default=True, metavar="NAME")
@click.option("--settings", type=click.Path(path_type=Path), help="JSON file of settings.")
@click.option(
    "--format", "form", type=click.Choice(list(WRITERS)), help="By default, after --out's suffix."
)
@click.option("--overwrite", is_flag=True, help="Replace what is there.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE.png", help="Draw it too.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def process(
    source: Path,
    out: Path,
    adapter: str | None,
    pipeline: str,
    settings: Path | None,
    form: str | None,
    overwrite: bool,
    plot: Path | None,
    as_json: bool,
) -> None:
    """Write the road profile of SOURCE: a recording directory, its JSON file, or a native file.

    OUT without a suffix is a profile directory, OUT.csv a table.
    """
    writer = WRITERS[form or _form(out)]
    check_target(out, overwrite)
    if plot is not None:
        check_target(plot, overwrite=True)
    reader = _reader(source, adapter)
    recording = reader.read(source)
    profile, warnings = _processed(recording, pipeline, _settings(settings), source, as_json)
    profile = replace(profile, provenance={**profile.provenance, **_origin(source, reader)})
    if plot is not None:
        _draw(profile, recording, plot)
    writer(profile, out, overwrite)
    _report(profile, out, warnings, as_json)


def _form(out: Path) -> str:
    # A suffix has letters only: names of runs hold numbers, as in stop_0.20g.
    suffix = out.suffix if out.suffix[1:].isalpha() else ""
    if suffix not in SUFFIXES:
        raise InputError(f"{out}: suffix {suffix} is no format; use .csv, no suffix, or --format")
    return SUFFIXES[suffix]


def _reader(source: Path, name: str | None) -> Adapter:
    known = plugins().adapters()
    if name is not None and name not in known:
        raise InputError(f"adapter {name}: unknown; there are {', '.join(known)}")
    if name is not None:
        return known[name]
    if not source.exists():
        raise InputError(f"{source}: not found")
    for adapter in known.values():
        if adapter.recognises(source):
            return adapter
    raise InputError(f"{source}: no adapter recognises it; name one of {', '.join(known)}")


def _settings(path: Path | None) -> Mapping[str, Any]:
    if path is None:
        return {}
    document = read_document(path)
    if not isinstance(document, dict):
        raise InputError(f"{path}: expected one JSON object of settings by name")
    return document


def _processed(
    recording: Recording, pipeline: str, settings: Mapping[str, Any], source: Path, quiet: bool
) -> tuple[Profile, tuple[str, ...]]:
    from rich.console import Console
    from rich.progress import Progress

    from floatref.architectures.processing import run

    console = Console(stderr=True)
    shown = console.is_terminal and not quiet
    with (
        naming(source),
        Progress(console=console, transient=True) if shown else nullcontext() as bar,
    ):
        task = bar.add_task("Processing", total=1.0) if bar else None
        result = run(
            recording,
            pipeline,
            settings,
            lambda done: bar.update(task, completed=done) if bar and task is not None else None,
        )
    return result.profile, result.warnings


def _origin(source: Path, reader: Adapter) -> dict[str, Any]:
    return {"source": source.name, "adapter": reader.name, "sha256": fingerprint(source)}


def _draw(profile: Profile, recording: Recording, plot: Path) -> None:
    from floatref.architectures.travel import travel_speed
    from floatref.plots import draw_profile

    draw_profile(profile, plot, travel_speed(recording))


def _report(profile: Profile, out: Path, warnings: tuple[str, ...], as_json: bool) -> None:
    tracks = [_track_report(track, profile.interval_m) for track in profile.tracks]
    report = {
        "pipeline": profile.pipeline,
        "profile": str(out),
        "interval_m": profile.interval_m,
        "length_m": profile.length_m,
        "tracks": tracks,
        "warnings": list(warnings),
    }
    if as_json:
        print_json(report)
        return
    rows = [
        [
            t["name"],
            number(profile.length_m, 2),
            number(t["iri_m_per_km"]),
            number(t["invalid_m"], 2),
        ]
        for t in tracks
    ]
    print_table(f"{out}", ("track", "length m", "IRI m/km", "invalid m"), rows)
    for line in warnings:
        click.echo(f"Warning: {line}", err=True)
    print_settings({"pipeline": profile.pipeline, **profile.settings})


def _track_report(track: ProfileTrack, interval_m: float) -> dict[str, Any]:
    from floatref.measures import iri

    return {
        "name": track.name,
        "iri_m_per_km": iri(track.elevation, interval_m),
        "invalid_m": float((~track.valid).sum()) * interval_m,
    }
