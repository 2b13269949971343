"""A channel map to begin with: what can be guessed is filled in, all else stands as a comment."""

import json
from collections.abc import Iterator
from pathlib import Path

from floatref.mapping.document import FORMAT
from floatref.mapping.guesses import Guess, guess
from floatref.mapping.naming import full_name
from floatref.mapping.taking import UNKNOWN
from floatref.mapping.units import known_unit
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
}
"""What is easily the other way round."""


def draft_map(native: NativeFile, source: Path, adapter: str, dbc: str | None = None) -> str:
    """Return the text of a channel map for ``native``, read from ``source`` with ``adapter``.

    Entries that nothing but a name speaks for, a second one for the same channel, and columns
    that are unlike any channel are comments.
    """
    return "\n".join([*_head(source, adapter, dbc), *_clocks(native), *_entries(native)]) + "\n"


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


def _clocks(native: NativeFile) -> Iterator[str]:
    for stream in native.streams:
        if stream.clock.name == UNKNOWN:
            yield "\n[[clocks]]"
            yield f"stream = {_text(stream.name)}"
            yield "rate_hz = 0  # the file has no time: state the rate in Hz"
    names = {(s.clock.name, s.clock.epoch) for s in native.streams if s.clock.name != UNKNOWN}
    if len(names) > 1 or any(epoch is Epoch.GPS for _, epoch in names):
        yield "\n# Clocks other than the accelerometer's need a word on how they are aligned:"
        yield '# [[clocks]]\n# stream = "…"\n# align = "offset"  # or "pulses" or "gnss"'
        yield "# offset_s = 0.0"


def _entries(native: NativeFile) -> Iterator[str]:
    seen: set[tuple[str, str | None]] = set()
    for stream in native.streams:
        for column in stream.columns:
            found = guess(stream.name, column)
            if found is None:
                yield _unlike(stream, column)
                continue
            active = found.sure and found[:2] not in seen
            seen.add(found[:2])
            yield _entry(stream, column, found, "" if active else "# ")


def _entry(stream: Stream, column: Column, found: Guess, mark: str) -> str:
    unit = column.unit or CHANNELS[found.channel].unit
    lines = [
        "[[channels]]",
        f"native = {_text(full_name(stream, column))}",
        f"channel = {_text(found.channel)}{_remark(found.channel)}",
    ]
    if found.track is not None:
        lines.append(f"track = {_text(found.track)}")
    doubt = "" if column.unit else "  # the file gives none: check it"
    if column.unit and known_unit(column.unit) is None:
        doubt = "  # not known: state another, with a scale"
    lines.append(f"unit = {_text(unit)}{doubt}")
    return "\n" + "\n".join(f"{mark}{line}" for line in lines)


def _unlike(stream: Stream, column: Column) -> str:
    unit = f", in {_comment(column.unit)}" if column.unit else ""
    note = f" ({_comment(column.note)})" if column.note else ""
    return f"\n# not mapped: {_comment(full_name(stream, column))}{unit}{note}"


def _remark(channel: str) -> str:
    return f"  # {SIGNS[channel]}" if channel in SIGNS else ""


def _text(text: str) -> str:
    """Return ``text`` as a TOML string."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _comment(text: str) -> str:
    """Return ``text`` as it may stand in a comment: printable and on one line."""
    return "".join(c if c.isprintable() else "?" for c in text[:200])
