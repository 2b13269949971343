"""`floatref channels`: a native file's content, a draft of its channel map, a trial of a map."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from floatref.cli.printing import number, print_json, print_table, progress_bar
from floatref.engine.recordings.readers import is_native, native_of, read_source, reader_of
from floatref.errors import InputError, one_line
from floatref.files.sources import real_path
from floatref.values.clock import UniformClock
from floatref.values.native import NativeClock, NativeFile, Stream
from floatref.values.recording import Recording


def print_streams(report: Mapping[str, Any]) -> None:
    """Print one line for every column of every stream, then the content that was not decoded."""
    rows = [row for stream in report["streams"] for row in _rows(stream)]
    title = one_line(f"{report['file']} ({report['adapter']})")
    headers = ("stream", "channel", "unit", "samples", "clock", "note")
    print_table(title, headers, rows, numbers=False)
    total = sum(stream["count"] for stream in report["streams"])
    click.echo(f"{len(report['streams'])} streams, {total} rows in all")
    _warn(report)


def print_mapped(report: Mapping[str, Any]) -> None:
    """Print the result for every channel, and the alignment of the clocks."""
    rows = [
        [
            c["channel"],
            one_line(c["native"]),
            str(c["count"]),
            number(c["rate_hz"], 3),
            f"{c['begin_s']:.3f}",
            f"{c['end_s']:.3f}",
            *(f"{c[key]:.6g}" for key in ("least", "mean", "greatest")),
            str(c["missing"]),
            c["unit"],
        ]
        for c in report["channels"]
    ]
    sampled = ("channel", "native", "samples", "Hz", "from s", "to s")
    headers = (*sampled, "least", "mean", "greatest", "missing", "unit")
    print_table(one_line(f"{report['file']} by {report['map']}"), headers, rows)
    for clock in report["clocks"]:
        click.echo(_clock_line(clock))
    for skew in report["skews"]:
        click.echo(_skew_line(skew))
    _warn(report)


def _rows(stream: Mapping[str, Any]) -> list[list[str]]:
    shared = [str(stream["count"]), stream["clock"]]
    if not stream["columns"]:
        return [[one_line(stream["name"]), "", "", *shared, ""]]
    name = one_line(stream["name"])
    columns = ([one_line(c[key]) for key in ("name", "unit", "note")] for c in stream["columns"])
    return [[name, column, unit, *shared, note] for column, unit, note in columns]


def _clock_line(clock: Mapping[str, Any]) -> str:
    name = " ".join(part for part in (clock["file"], clock["stream"]) if part) or "the source"
    line = f"Clock of {one_line(name)}: by {clock['align']}, {clock['offset_s']:+.6f} s"
    if clock["pairs"]:
        line += (
            f", drift {clock['drift_ppm']:+.3f} ± {clock['drift_sigma_ppm']:.3f} ppm, "
            f"{1e3 * clock['residual_s']:.3f} ms rms over {clock['pairs']} pairs"
        )
    return line


def _skew_line(skew: Mapping[str, Any]) -> str:
    line = f"Skew of {skew['track']}, height after accelerometer: "
    if skew["reason"]:
        return f"{line}open, {skew['reason']}"
    late, sigma = (1e3 * skew[key] for key in ("skew_s", "sigma_s"))
    return f"{line}{late:+.2f} ± {sigma:.2f} ms, measured by {skew['seconds']:.3g} s"


def _warn(report: Mapping[str, Any]) -> None:
    for line in report["warnings"]:
        click.echo(f"Warning: {one_line(line)}", err=True)


@click.command("channels")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--draft-map", is_flag=True, help="Print a channel map to begin with.")
@click.option("--adapter", metavar="NAME", help="Read FILE with this adapter.")
@click.option(
    "--map",
    "channel_map",
    type=click.Path(path_type=Path),
    metavar="FILE.toml",
    help="Try this channel map and show the resulting channels.",
)
@click.option(
    "--dbc", type=click.Path(path_type=Path), metavar="FILE", help="Signals of a CAN log."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def channels(
    file: Path,
    draft_map: bool,
    adapter: str | None,
    channel_map: Path | None,
    dbc: Path | None,
    as_json: bool,
) -> None:
    """List what FILE holds: its channels, units and clocks, and content that could not be decoded.

    With --map every channel is read, converted to SI units and one time base, and checked.
    """
    if channel_map is not None:
        if draft_map or dbc is not None:
            raise InputError("--map takes no --draft-map or --dbc; name the dbc file in the map")
        _try(file, adapter, channel_map, as_json)
        return
    reader = reader_of(file, adapter)
    if not is_native(reader):
        _list_recording(read_source(reader, file), file, reader.name, draft_map, as_json)
        return
    options = {} if dbc is None else {"dbc": str(real_path(dbc))}
    with native_of(reader, file, options) as native:
        if draft_map:
            _draft(native, file, reader.name, dbc)
            return
        report = _list_streams(native, file, reader.name)
    print_json(report) if as_json else print_streams(report)


def _draft(native: NativeFile, file: Path, adapter: str, dbc: Path | None) -> None:
    from floatref.mapping.draft.drafting import draft_map

    click.echo(draft_map(native, file, adapter, None if dbc is None else dbc.name), nl=False)
    for line in native.warnings:
        click.echo(f"Warning: {one_line(line)}", err=True)


def _try(file: Path, adapter: str | None, channel_map: Path, as_json: bool) -> None:
    from floatref.mapping.reading import read_native
    from floatref.mapping.report import inspect_reading

    with progress_bar("Reading", as_json) as shown:
        reading = read_native(file, channel_map, adapter, shown)
    report = {"file": str(file), "map": str(channel_map), **inspect_reading(reading)}
    print_json(report) if as_json else print_mapped(report)


def _list_recording(
    recording: Recording, file: Path, adapter: str, draft: bool, as_json: bool
) -> None:
    """List a recording whose adapter maps its channels itself."""
    if draft:
        raise InputError(f"{file}: adapter {adapter} has our channels; it needs no map")
    streams = [
        {
            "name": "",
            "count": channel.values.size,
            "rate_hz": channel.mean_rate_hz,
            "clock": _describe_rate(channel.clock.rate)
            if isinstance(channel.clock, UniformClock)
            else "time stamps",
            "columns": [{"name": str(channel.id), "unit": channel.unit, "note": ""}],
        }
        for channel in recording.channels
    ]
    report = {"file": str(file), "adapter": adapter, "streams": streams, "warnings": []}
    print_json(report) if as_json else print_streams(report)


def _list_streams(native: NativeFile, file: Path, adapter: str) -> dict[str, Any]:
    """Return the JSON document of `floatref channels --json`."""
    return {
        "file": str(file),
        "adapter": adapter,
        "device": {"vendor": native.vendor, "model": native.model},
        "streams": [_stream(stream) for stream in native.streams],
        "warnings": list(native.warnings),
    }


def _stream(stream: Stream) -> dict[str, Any]:
    clock = stream.clock
    return {
        "name": stream.name,
        "count": stream.count,
        "rate_hz": None if clock.rate is None else float(clock.rate),
        "clock": _describe_clock(clock),
        "columns": [
            {"name": c.name, "unit": c.unit, "numeric": c.numeric, "note": c.note}
            for c in stream.columns
        ],
    }


def _describe_clock(clock: NativeClock) -> str:
    from floatref.mapping.clocks.columns import UNKNOWN

    if clock.name == UNKNOWN:
        return "none"
    rate = "time stamps" if clock.rate is None else _describe_rate(clock.rate)
    named = f", clock {clock.name}" if clock.name else ""
    return f"{rate}, {clock.epoch.value}{named}"


def _describe_rate(rate: Any) -> str:
    return f"{float(rate):.10g} Hz"
