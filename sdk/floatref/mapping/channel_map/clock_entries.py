"""The entries of a channel map for the alignment of clocks, checked."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from floatref.errors import InputError
from floatref.files.document import show
from floatref.files.sources import name_errors
from floatref.mapping.channel_map.entries import SOURCE, ClockEntry
from floatref.values.clock import rational

NEEDS = {
    "offset_s": ("offset", "pulses", "gnss"),
    "drift_ppm": ("offset",),
    "pulses": ("pulses",),
    "base_pulses": ("pulses",),
    "base_time": ("gnss",),
    "base_pps": ("gnss",),
}
"""Keys, and the ways of aligning that use them."""


def clocks_of(entries: Sequence[Mapping[str, Any]]) -> tuple[ClockEntry, ...]:
    """Return the clocks that ``entries``, valid by the schema, describe.

    Raises InputError for a clock that is given twice or has no content, and for keys that its way
    of aligning does not use, or needs and lacks.
    """
    found: dict[tuple[str, str | None], ClockEntry] = {}
    for entry in entries:
        with name_errors(f"clock of {name_stream(entry.get('file', SOURCE), entry.get('stream'))}"):
            clock = _clock(entry)
            if (clock.file, clock.stream) in found:
                raise InputError("given twice; keep one entry")
        found[clock.file, clock.stream] = clock
    return tuple(found.values())


def name_stream(file: str, stream: str | None) -> str:
    """Return ``stream`` of the file labelled ``file`` as an error text names it."""
    place = "the source" if file == SOURCE else show(file)[1:-1]
    return place if stream is None else f"{place}, stream {show(stream)}"


def _clock(entry: Mapping[str, Any]) -> ClockEntry:
    given = dict(entry)
    rate = _rate(given.pop("rate_hz", None))
    align = given.get("align")
    for key, ways in NEEDS.items():
        if key in given and align not in ways:
            written = " or ".join(f'align = "{way}"' for way in ways)
            raise InputError(f"{key} is given; write {written} as well, or leave it out")
    if "start_s" in given and rate is None:
        raise InputError("start_s is given; write rate_hz as well, or leave it out")
    if align is None and rate is None:
        raise InputError('has no content; write align, such as align = "offset", or rate_hz')
    if align == "pulses" and not {"pulses", "base_pulses"} <= given.keys():
        raise InputError(
            "align by pulses needs pulses and base_pulses, the channels that hold them"
        )
    if {"base_time", "base_pps"} <= given.keys():
        raise InputError("base_time and base_pps are given; keep one of them")
    return ClockEntry(rate=rate, **given)


def _rate(given: float | str | None) -> Fraction | None:
    if given is None:
        return None
    try:
        rate = Fraction(given) if isinstance(given, str) else rational(given)
    except ZeroDivisionError:
        rate = Fraction(0)
    if not Fraction(1, 1000) <= rate <= 10**7:
        raise InputError(f"rate_hz is {given}; give the rate in Hz, between 0.001 and 10000000")
    return rate
