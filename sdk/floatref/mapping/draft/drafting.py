"""A channel map to begin with: guesses are filled in, everything else is a comment."""

import json
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from floatref.errors import InputError, one_line
from floatref.files.toml_document import MOST_PARTS
from floatref.mapping.channel_map.column_names import find, full_name
from floatref.mapping.channel_map.conversion import Conversion
from floatref.mapping.channel_map.entries import ChannelEntry
from floatref.mapping.channel_map.map_document import FORMAT
from floatref.mapping.channel_map.units import MPS, known_unit
from floatref.mapping.clocks.clock_keys import has_no_start
from floatref.mapping.clocks.columns import UNKNOWN
from floatref.mapping.draft.guesses import Candidate, Guess, candidates
from floatref.values.channels import CHANNELS
from floatref.values.native import Column, Epoch, NativeFile, Stream

SIGNS = {
    "vertical_specific_force": "+9.8 at rest",
    "height": "range down to the road, positive",
    "gnss_pitch": "nose down positive: sign = -1 if the receiver reports nose up",
    "gnss_roll": "left side up positive",
    "pitch_rate": "right-handed about +Y (left): nose down positive",
    "yaw_rate": "right-handed about +Z (up): left turn positive",
    "roll_rate": "right-handed about +X (forward): left side up positive",
    "unsprung_specific_force": "+9.8 at rest",
    "rear_unsprung_specific_force": "+9.8 at rest",
    "sprung_specific_force": "+9.8 at rest",
    "equipment_specific_force": "+9.8 at rest",
    "suspension_deflection": "against rest, positive where the wheel hangs lower",
    "rear_suspension_deflection": "against rest, positive where the wheel hangs lower",
    "pitch_angle": "against rest, nose down positive",
    "roll_angle": "against rest, left side up positive",
}
"""Sign conventions that are easily reversed."""
EITHER = {"height": "; to the axle it is suspension_deflection"}
"""Alternative channel of an uncertain one."""
NOSE_DOWN = ("gnss_pitch", "pitch_rate", "pitch_angle", "pitch_acceleration")
"""Channels that are reversed if an adapter's note gives the other sign."""
VEHICLE = """
# [setup.vehicle]  # for an estimate of the road from the response
# model = "quarter-car"  # the corner that is measured
# x_m = 0.0  # its wheel ahead of the one point of the vehicle
# parameters.sprung_kg = 0
# parameters.unsprung_kg = 0
# parameters.suspension_n_per_m = 0
# parameters.suspension_ns_per_m = 0
# parameters.tyre_n_per_m = 0"""
"""The table that a map has where wheels are measured, to be completed."""


def remark(found: Guess) -> str:
    """Return the comment behind the channel of an entry, "" if it has no comment."""
    either = "" if found.sure else EITHER.get(found.channel, "")
    return f"  # {SIGNS[found.channel]}{either}" if found.channel in SIGNS else ""


def is_turned(found: Guess, note: str) -> bool:
    """Tell whether ``found`` has the other sign by the ``note`` of an adapter."""
    return found.channel in NOSE_DOWN and "nose up positive" in note


def vehicle(found: Iterable[Guess | None]) -> Iterator[str]:
    """Yield the table of the vehicle if an accelerometer of a wheel is among ``found``."""
    if any(g is not None and g.channel.endswith("unsprung_specific_force") for g in found):
        yield VEHICLE


MOST_CHANNELS = 256
LONGEST_TEXT = 256
"""What the schema of maps allows."""


def draft_map(native: NativeFile, source: Path, adapter: str, dbc: str | None = None) -> str:
    """Return the text of a channel map for ``native``, read from ``source`` with ``adapter``.

    Entries guessed from a name alone, a second one for the same channel, and columns that are
    unlike any channel are comments.
    """
    used: set[str] = set()
    known = candidates(native)
    entries = list(_entries(native, known, used))
    setup = [*_head(source, adapter, dbc), *vehicle(c.guess for c in known)]
    return "\n".join([*setup, *_clocks(native, used), *entries]) + "\n"


def _head(source: Path, adapter: str, dbc: str | None) -> Iterator[str]:
    yield f"# Channel map of {_comment(source.name)}: check every line, above all signs and units."
    yield f'format = "{FORMAT}"'
    yield "\n[source]"
    yield f"adapter = {_text(adapter)}"
    if dbc is not None:
        yield f"dbc = {_text(dbc)}"
    yield "\n[setup]"
    yield "# Offsets in m from one point of the vehicle: X forward, Y left, Z up."
    yield "profile_interval_m = 0.00508"
    yield "# gnss_antenna_offset_m = [0.0, 0.0, 0.0]"
    yield "# tracks.left = { reference_point_m = [0, 0, 0], laser_offset_m = [0, 0, 0] }"
    yield "# axles = { wheelbase_m = 3.0, front_axle_m = 1.5 }"


def _clocks(native: NativeFile, used: set[str]) -> Iterator[str]:
    """Write the missing clock entries of the streams that are ``used``."""
    for stream in native.streams:
        if stream.clock.name == UNKNOWN:
            mark = "" if stream.name in used else "# "
            yield f"\n{mark}[[clocks]]"
            yield f"{mark}stream = {_text(stream.name)}"
            yield f"{mark}rate_hz = 0  # the file has no time: state the rate in Hz"
    timed = [s for s in native.streams if s.clock.name != UNKNOWN]
    names = {(s.clock.name, s.clock.epoch) for s in timed}
    if len(names) > 1 or any(epoch is Epoch.GPS for _, epoch in names):
        yield "\n# Clocks other than the accelerometer's need an entry with their alignment:"
    elif sum(map(has_no_start, timed)) > 1:
        yield "\n# Streams are counted from zero, each by its rate. One that began later, or that"
        yield "# has a clock other than the accelerometer's, needs an entry with its alignment:"
    else:
        return
    yield '# [[clocks]]\n# stream = "…"\n# align = "offset"  # or "pulses" or "gnss"'
    yield "# offset_s = 0.0"


def _entries(native: NativeFile, known: Sequence[Candidate], used: set[str]) -> Iterator[str]:
    """Write an entry for every column; note in ``used`` the streams of those that count."""
    seen: set[tuple[str, str | None]] = set()
    for stream, column, found in known:
        if found is None:
            yield _unlike(stream, column)
            continue
        active = found.sure and found[:2] not in seen and len(seen) < MOST_CHANNELS
        active = active and not _lesser(known, column, found)
        active = active and _maps(native, stream, column, found)
        if active:
            seen.add(found[:2])
            used.add(stream.name)
        yield _entry(stream, column, found, "" if active else "# ")


def _lesser(known: Sequence[Candidate], column: Column, found: Guess) -> bool:
    """Tell whether the file has a better column than ``column`` for its channel.

    A height over the ellipsoid rather than over a geoid model, whose steps no road has; a length
    rather than a speed, which has to be integrated.
    """
    if found.channel == "distance" and _si(column) == MPS:
        return any(_si(other.column) == "m" and other.guess == found for other in known)
    if found.channel != "gnss_height" or _ellipsoidal(column):
        return False
    return any(_ellipsoidal(other.column) for other in known)


def _si(column: Column) -> str | None:
    unit = known_unit(column.unit)
    return None if unit is None else unit.si


def _ellipsoidal(column: Column) -> bool:
    return "ellips" in column.name.lower()


def _maps(native: NativeFile, stream: Stream, column: Column, found: Guess) -> bool:
    """Tell whether the entry for ``column`` can be read unchanged, and means that column."""
    name, unit = full_name(stream, column), _unit(column, found)
    if not all(map(_writable, (name, unit, stream.name))):
        return False
    try:
        place = find(native, name)
        Conversion(ChannelEntry(name, found.channel, track=found.track, unit=unit), column)
    except InputError:
        return False
    return place[0] is stream and place[1] is column


def _unit(column: Column, found: Guess) -> str:
    return column.unit.strip() or CHANNELS[found.channel].unit


def _writable(text: str) -> bool:
    """Tell whether a channel map can hold ``text``: TOML has no lone surrogates."""
    return len(text) <= LONGEST_TEXT and not any("\ud800" <= c <= "\udfff" for c in text)


def _entry(stream: Stream, column: Column, found: Guess, mark: str) -> str:
    note = f"  # {_comment(column.note)}" if column.note else ""
    lines = [
        "[[channels]]",
        f"native = {_text(full_name(stream, column))}{note}",
        f"channel = {_text(found.channel)}{remark(found)}",
    ]
    if is_turned(found, column.note):
        lines.append("sign = -1")
    if found.track is not None:
        lines.append(f"track = {_text(found.track)}")
    doubt = "" if column.unit.strip() else "  # not given by the file: check it"
    if column.unit.strip() and known_unit(column.unit) is None:
        doubt = "  # not known: state another, with a scale"
    if _si(column) == "1" != CHANNELS[found.channel].unit:
        si = CHANNELS[found.channel].unit
        lines.append(f"scale = 0  # {si} per count: state it; and wrap, where counts start again")
        lines.append(f'unit = "{si}"')
    else:
        lines.append(f"unit = {_text(_unit(column, found))}{doubt}")
    return "\n" + "\n".join(f"{mark}{line}" for line in lines)


def _unlike(stream: Stream, column: Column) -> str:
    unit = f", in {_comment(column.unit)}" if column.unit else ""
    note = f" ({_comment(column.note)})" if column.note else ""
    return f"\n# not mapped: {_comment(full_name(stream, column))}{unit}{note}"


def _text(text: str) -> str:
    """Return ``text`` as a TOML string, on one line and printable."""
    quoted = json.dumps(text, ensure_ascii=False)
    dotted = text.count(".") >= MOST_PARTS
    return "".join(
        c if c.isprintable() and not (dotted and c == ".") else _escape(c) for c in quoted
    )


def _escape(character: str) -> str:
    """Return ``character`` as TOML escapes it; a lone surrogate, which TOML forbids, as U+FFFD."""
    code = ord(character)
    return f"\\U{0xFFFD if 0xD800 <= code <= 0xDFFF else code:08X}"


def _comment(text: str) -> str:
    """Return ``text`` for a comment: printable, on one line and without a row of dots."""
    plain = one_line(text[:200])
    return plain.replace(".", "·") if plain.count(".") >= MOST_PARTS else plain
