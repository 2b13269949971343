"""`floatref process`: a recording, or a native file, into a road profile."""

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from floatref.cli.diagnostics import (
    check_picture,
    draw_beside,
    print_innovations,
    report_innovations,
)
from floatref.cli.format_option import FormatName
from floatref.cli.iri_tables import print_track_table
from floatref.cli.printing import print_json, print_settings, progress_bar
from floatref.engine.choosing import AUTO
from floatref.engine.formats import format_of, write_as
from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_file
from floatref.files.settings_file import read_settings
from floatref.files.sources import real_path
from floatref.mapping.sources import make_profile, recording_of
from floatref.values.profile import Profile, ProfileTrack

if TYPE_CHECKING:
    from floatref.engine.run import Result


@click.command("process")
@click.argument("source", type=click.Path(path_type=Path))
@click.option("-o", "--out", required=True, type=click.Path(path_type=Path), help="Where to write.")
@click.option("--adapter", metavar="NAME", help="Read SOURCE with this adapter.")
@click.option(
    "--map",
    "channel_map",
    type=click.Path(path_type=Path),
    metavar="FILE.toml",
    help="Channel map of a native file.",
)
@click.option("--pipeline", default=AUTO, show_default=True, metavar="NAME")
@click.option("--settings", type=click.Path(path_type=Path), help="JSON file of settings.")
@click.option("--format", "form", type=FormatName(), help="By default, from the suffix of --out.")
@click.option("--overwrite", is_flag=True, help="Replace an existing target.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE.png", help="Draw it too.")
@click.option(
    "--diagnostics",
    is_flag=True,
    help="Record whether the filter's innovations are as large as it expects, and draw them: "
    "OUT.innovations.png.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def process(
    source: Path,
    out: Path,
    adapter: str | None,
    channel_map: Path | None,
    pipeline: str,
    settings: Path | None,
    form: str | None,
    overwrite: bool,
    plot: Path | None,
    diagnostics: bool,
    as_json: bool,
) -> None:
    """Write the road profile of SOURCE: a recording directory, its JSON file, or a native file.

    The suffix of OUT selects the format; without a suffix it is a profile directory.
    """
    written = format_of(out, form)
    _check_targets(source, out, plot, overwrite)
    if diagnostics:
        check_picture(out, plot, overwrite)
    chosen = read_settings(settings)
    with progress_bar("Reading", as_json) as shown:
        read = recording_of(source, adapter, channel_map, shown)
    # Before the first block is done, loops may be compiled: seconds, once per installation.
    starting = "Starting (the first time, this compiles)"
    with progress_bar("Processing", as_json, starting) as shown:
        result = make_profile(read, pipeline, chosen, shown, diagnostics)
    profile = result.profile
    report = _report(profile, out, result.warnings)
    report |= report_innovations(result, out) if diagnostics else {}
    with _draw(result, plot), draw_beside(result, out) if diagnostics else nullcontext():
        write_as(written, profile, out, overwrite)
    print_json(report) if as_json else _print_tables(report, profile)


def _check_targets(source: Path, out: Path, plot: Path | None, overwrite: bool) -> None:
    """Raise InputError now for a target to which writing would fail later."""
    check_target(out, overwrite)
    if real_path(out) == real_path(source) or real_path(source) in real_path(out).parents:
        raise InputError(f"{out}: is, or is inside, the source; choose another place")
    if plot is None:
        return
    if real_path(plot) == real_path(out):
        raise InputError(f"{plot}: is the profile's own name; choose another for the drawing")
    from floatref.plots import check_drawing

    check_target(plot, overwrite=True)
    check_drawing(plot)


@contextmanager
def _draw(result: "Result", plot: Path | None) -> Iterator[None]:
    """Draw beside ``plot``; the drawing gets its name after everything else is written."""
    if plot is None:
        yield
        return
    from floatref.plots import draw_profile

    with replace_file(plot, overwrite=True) as beside:
        draw_profile(result.profile, beside, result.screening.travel)
        yield


def _report(profile: Profile, out: Path, warnings: tuple[str, ...]) -> dict[str, Any]:
    """Return the JSON document of `floatref process --json`."""
    lines = list(warnings)
    return {
        "pipeline": profile.pipeline,
        "reason": profile.provenance.get("chosen", {}).get("reason"),
        "profile": str(out),
        "interval_m": profile.interval_m,
        "length_m": profile.length_m,
        "tracks": [_track_report(t, profile, lines) for t in profile.tracks],
        "warnings": lines,
    }


def _track_report(track: ProfileTrack, profile: Profile, warnings: list[str]) -> dict[str, Any]:
    from floatref.cli.iri import figures_of, no_figures

    try:
        figures = figures_of(track, profile)
    except InputError as error:
        # A profile too short or too coarse for the IRI car is still a valid result.
        warnings.append(f"track {track.name}: no IRI: {error}")
        figures = no_figures(float(track.valid.size - track.valid.sum()) * profile.interval_m)
    return {"name": track.name, **figures}


def _print_tables(report: dict[str, Any], profile: Profile) -> None:
    print_track_table(report["profile"], report["length_m"], report["tracks"])
    if report["reason"]:
        click.echo(f"Pipeline {report['pipeline']}, since {report['reason']}")
    for line in report["warnings"]:
        click.echo(f"Warning: {line}", err=True)
    architecture = profile.provenance["architecture"]
    named = {"pipeline": profile.pipeline, "architecture": architecture}
    if "innovations" in report:
        print_innovations(report)
    print_settings({**named, **profile.settings})
