"""The tables of `floatref channels`."""

from collections.abc import Mapping
from typing import Any

import click

from floatref.cli.printing import number, print_table
from floatref.errors import one_line


def print_streams(report: Mapping[str, Any]) -> None:
    """Print one line for every column of every stream, then what was not decoded."""
    rows = [row for stream in report["streams"] for row in _rows(stream)]
    title = one_line(f"{report['file']} ({report['adapter']})")
    headers = ("stream", "channel", "unit", "samples", "clock", "note")
    print_table(title, headers, rows, numbers=False)
    total = sum(stream["count"] for stream in report["streams"])
    click.echo(f"{len(report['streams'])} streams, {total} rows in all")
    _warn(report)


def print_mapped(report: Mapping[str, Any]) -> None:
    """Print what became of every channel, and how clocks were aligned."""
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
    told = ([one_line(c[key]) for key in ("name", "unit", "note")] for c in stream["columns"])
    return [[name, column, unit, *shared, note] for column, unit, note in told]


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
    return f"{line}{late:+.2f} ± {sigma:.2f} ms, told by {skew['seconds']:.3g} s"


def _warn(report: Mapping[str, Any]) -> None:
    for line in report["warnings"]:
        click.echo(f"Warning: {one_line(line)}", err=True)
