"""What the sentences of NMEA 0183 hold: the fields that are numbers, and where the time is."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from floatref import Column

Fields = Sequence[str]
"""Of a sentence, behind its name, with empty ones behind them up to `MOST`."""
MOST = 16
NAN = float("nan")
LARGEST = 1e15
ANGLE = re.compile(r"(\d{1,3})([0-5]\d(?:\.\d*)?)$", re.ASCII)
MODES = {"R": 4.0, "F": 5.0, "P": 3.0, "D": 2.0, "A": 1.0, "E": 6.0, "M": 7.0, "S": 8.0, "N": 0.0}
"""Modes of GNS as the quality of GGA; the first of several that a sentence has counts."""


class NotANumber(ValueError):
    """A field holds something, and it is no number."""


@dataclass(frozen=True)
class Quantity:
    """A column, and how to have its value from the fields of a sentence; NaN if they are empty."""

    column: Column
    value: Callable[[Fields], float]


@dataclass(frozen=True)
class Layout:
    """Of one kind of sentence: fewest fields, where the time is, what it measures."""

    fewest: int
    time: int | None
    quantities: tuple[Quantity, ...]


def number(text: str) -> float:
    """Return the number ``text``, NaN if it is empty; NotANumber."""
    if not text:
        return NAN
    try:
        value = float(text)
    except ValueError:
        raise NotANumber(text) from None
    # Python also reads inf, nan and 1_0.
    if not -LARGEST < value < LARGEST or "_" in text:
        raise NotANumber(text)
    return value


def _plain(name: str, unit: str, at: int, note: str = "") -> Quantity:
    return Quantity(Column(name, unit, note), lambda fields: number(fields[at]))


def _angle(name: str, at: int, sides: str, limit: int) -> Quantity:
    """Return the angle `dddmm.mm` in the field ``at``, the second of ``sides`` being negative."""

    def value(fields: Fields) -> float:
        text, side = fields[at], fields[at + 1].upper()
        if not text:
            return NAN
        found = ANGLE.match(text)
        if found is None or not side or side not in sides:
            raise NotANumber(f"{text},{side}")
        degrees = int(found[1]) + float(found[2]) / 60
        if degrees > limit:
            raise NotANumber(text)
        return -degrees if side == sides[1] else degrees

    return Quantity(Column(name, "deg", f"{sides[0]} positive"), value)


def _place(at: int) -> tuple[Quantity, Quantity]:
    return _angle("latitude", at, "NS", 90), _angle("longitude", at + 2, "EW", 180)


def _sum(name: str, unit: str, first: int, second: int, note: str) -> Quantity:
    def value(fields: Fields) -> float:
        return number(fields[first]) + number(fields[second])

    return Quantity(Column(name, unit, note), value)


def _flag(name: str, at: int, good: str) -> Quantity:
    def value(fields: Fields) -> float:
        text = fields[at]
        return NAN if not text else float(text == good)

    return Quantity(Column(name, "", f"1 where the sentence has {good}"), value)


def _mode(fields: Fields) -> float:
    return next((MODES[mode] for mode in MODES if mode in fields[5]), NAN)


def _variation(fields: Fields) -> float:
    size = number(fields[9])
    return -size if fields[10].upper() == "W" else size


QUALITY = "0 no fix, 1 single, 2 differential, 4 RTK fixed, 5 RTK float"
OF_EPOCH = "its time is that of the last sentence with one"


def _heights(at: int, separation: int) -> tuple[Quantity, ...]:
    return (
        _plain("altitude", "m", at, "above the geoid (mean sea level)"),
        _plain("geoid_separation", "m", separation, "geoid above the ellipsoid"),
        _sum("ellipsoidal_height", "m", at, separation, "altitude + geoid_separation"),
    )


def _sigmas(at: int) -> tuple[Quantity, ...]:
    names = ("latitude_sigma", "longitude_sigma", "altitude_sigma")
    return tuple(_plain(name, "m", at + k, "1 sigma") for k, name in enumerate(names))


LAYOUTS = {
    "GGA": Layout(
        14,
        0,
        (
            *_place(1),
            *_heights(8, 10),
            _plain("quality", "", 5, QUALITY),
            _plain("satellites", "", 6),
            _plain("hdop", "", 7),
            _plain("correction_age", "s", 12),
        ),
    ),
    "GNS": Layout(
        12,
        0,
        (
            *_place(1),
            *_heights(8, 9),
            Quantity(Column("quality", "", f"best mode: {QUALITY}"), _mode),
            _plain("satellites", "", 6),
            _plain("hdop", "", 7),
            _plain("correction_age", "s", 10),
        ),
    ),
    "RMC": Layout(
        9,
        0,
        (
            *_place(2),
            _plain("speed", "kn", 6, "over ground"),
            _plain("course", "deg", 7, "over ground, from true north"),
            Quantity(Column("magnetic_variation", "deg", "E positive"), _variation),
            _flag("valid", 1, "A"),
        ),
    ),
    "GLL": Layout(6, 4, (*_place(0), _flag("valid", 5, "A"))),
    "VTG": Layout(
        8,
        None,
        (
            _plain("course", "deg", 0, f"from true north; {OF_EPOCH}"),
            _plain("course_magnetic", "deg", 2),
            _plain("speed_kn", "kn", 4, "over ground"),
            _plain("speed", "km/h", 6, "over ground"),
        ),
    ),
    "ZDA": Layout(
        4, 0, (_plain("day", "", 1), _plain("month", "", 2), _plain("year", "", 3, "of UTC"))
    ),
    "GST": Layout(
        8,
        0,
        (
            _plain("residual_rms", "m", 1),
            _plain("semi_major_sigma", "m", 2),
            _plain("semi_minor_sigma", "m", 3),
            _plain("semi_major_course", "deg", 4, "from true north"),
            *_sigmas(5),
        ),
    ),
    "HDT": Layout(2, None, (_plain("heading", "deg", 0, f"from true north; {OF_EPOCH}"),)),
    "PASHR": Layout(
        7,
        0,
        (
            _plain("heading", "deg", 1, "from true north"),
            _plain("roll", "deg", 3),
            _plain("pitch", "deg", 4),
            _plain("heave", "m", 5),
            _plain("roll_sigma", "deg", 6, "1 sigma"),
            _plain("pitch_sigma", "deg", 7, "1 sigma"),
            _plain("heading_sigma", "deg", 8, "1 sigma"),
            _plain("gnss_status", "", 9),
            _plain("imu_status", "", 10),
        ),
    ),
}
"""By the name of the sentence without its talker; fields are counted after that name."""
