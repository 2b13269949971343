"""The tables of `floatref allan`: channels, their noise coefficients, and settings."""

from collections.abc import Iterator, Mapping, Sequence
from math import nan, pi
from types import MappingProxyType

import click

from floatref.cli.allan.allan_report import SETTINGS, recommend_settings, unit_of
from floatref.cli.printing import number, print_table
from floatref.measures.allan.at_rest import ChannelNoise
from floatref.measures.allan.noise_fit import NoiseCoefficients
from floatref.values.channels import STANDARD_GRAVITY

DEGREES = 180.0 / pi
CUSTOMARY: Mapping[str, tuple[float, str]] = MappingProxyType(
    {
        "rad/s/√Hz": (60.0 * DEGREES, "deg/√h"),
        "rad/s/√s": (3600.0 * 60.0 * DEGREES, "deg/h/√h"),
        "rad/s": (3600.0 * DEGREES, "deg/h"),
        "rad/s/s": (3600.0**2 * DEGREES, "deg/h/h"),
        "m/s²/√Hz": (1e6 / STANDARD_GRAVITY, "µg/√Hz"),
        "m/s²/√s": (1e6 / STANDARD_GRAVITY, "µg/√s"),
        "m/s²": (1e6 / STANDARD_GRAVITY, "µg"),
        "m/√Hz": (1e3, "mm/√Hz"),
        "m/√s": (1e3, "mm/√s"),
        "m": (1e3, "mm"),
        "rad/√Hz": (DEGREES, "deg/√Hz"),
        "rad/√s": (DEGREES, "deg/√s"),
        "rad": (DEGREES, "deg"),
    }
)
"""Factor from a coefficient to the unit of data sheets, and that unit."""


def print_tables(found: Sequence[ChannelNoise], warnings: Sequence[str]) -> None:
    """Print channels, coefficients and settings on stdout, and warnings on stderr."""
    columns = ("coefficient", "value", "±", "unit", "customary", "largest from s", "to s")
    for noise in found:
        rows = [row for term in NoiseCoefficients._fields for row in _rows(noise, term)]
        print_table(_title(noise), columns, rows)
    print_table(
        "Settings of the Kalman pipelines",
        ("setting", "value", "unit", "from"),
        _setting_rows(found),
    )
    for line in warnings:
        click.echo(f"Warning: {line}", err=True)


def _title(noise: ChannelNoise) -> str:
    """Return the analysed span, its standard deviation, and the error of the curve."""
    factor, at_s = noise.fit.worst()
    unit = noise.unit.replace("^2", "²")
    return (
        f"{noise.id}: {noise.begin_s:.6g} s to {noise.end_s:.6g} s at "
        f"{1.0 / noise.allan.interval_s:.6g} Hz, σ {noise.allan.standard_deviation:.3g} {unit}, "
        f"curve off by a factor of {factor:.3g} at {_seconds(at_s)} s"
    )


def _rows(noise: ChannelNoise, term: str) -> Iterator[list[str]]:
    """Yield the row of ``term`` if it was found, or its bound if a setting needs it."""
    value, unit = getattr(noise.fit.coefficients, term), unit_of(term, noise.unit)
    name = term.replace("_", " ")
    if value > 0:
        factor, customary = CUSTOMARY.get(unit, (1.0, ""))
        begin, end = noise.fit.dominates(term) or (nan, nan)
        yield [
            *(
                name,
                f"{value:.3g}",
                f"{100 * getattr(noise.fit.uncertainties, term) / value:.2g} %",
            ),
            *(unit, f"{factor * value:.3g} {customary}" if customary else ""),
            *(_seconds(begin), _seconds(end)),
        ]
    elif (noise.id.name, term) in SETTINGS.values():
        limit = getattr(noise.fit.limits, term)
        yield [name, f"< {limit:.2g}", "", unit, "", "–", "–"]


def _setting_rows(found: Sequence[ChannelNoise]) -> Iterator[list[str]]:
    values = recommend_settings(found)
    for name, (channel, term) in SETTINGS.items():
        if name in values:
            value, noise = values[name]
            yield [name, f"{value:.4g}", unit_of(term, noise.unit), str(noise.id)]
        elif any(noise.id.name == channel for noise in found):
            yield [name, "–", "", "not seen, or off the curve"]


def _seconds(time_s: float) -> str:
    """Return a cluster time with three digits, a dash for NaN."""
    return f"{time_s:.3g}" if abs(time_s) < 1000.0 else number(time_s, 0)
