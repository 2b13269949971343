"""Ten ways in which a file of a network is no recording, each with the formats it is told by.

A format that says nothing of its own bytes cannot tell that they are others, and a log that is cut
off is read as far as it goes; so every way names the formats in which the file is lost.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from floatref import Channel, Recording

DIRECTORY = ""
"""In place of a suffix: a recording directory."""


def truncated(path: Path) -> None:
    """Leave the first two thirds."""
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 2 // 3])


def emptied(path: Path) -> None:
    """Leave no byte."""
    path.write_bytes(b"")


def headless(path: Path) -> None:
    """Put zeros in place of the first 512 bytes."""
    path.write_bytes(bytes(512) + path.read_bytes()[512:])


def flipped(path: Path) -> None:
    """Turn every bit of 64 bytes in the middle."""
    content = bytearray(path.read_bytes())
    middle = slice(len(content) // 2, len(content) // 2 + 64)
    content[middle] = bytes(byte ^ 0xFF for byte in content[middle])
    path.write_bytes(content)


def text(path: Path) -> None:
    """Put what a web server says in place of the file."""
    path.write_text("<html><body><h1>404 Not Found</h1></body></html>\n")


def sampleless(path: Path) -> None:
    """Remove a file of samples."""
    next(iter(sorted(path.glob("*height*")))).unlink()


def broken(path: Path) -> None:
    """Leave half of the JSON file."""
    truncated(path / "recording.json")


def unlike(path: Path) -> None:
    """Say of the height that it is in kg."""
    document = json.loads((path / "recording.json").read_text())
    for channel in document["channels"]:
        if channel["name"] == "height":
            channel["unit"] = "kg"
    (path / "recording.json").write_text(json.dumps(document))


def heightless(recording: Recording) -> Recording:
    """Return the recording without its laser, as after a day with a dead sensor."""
    return replace(recording, channels=tuple(c for c in recording.channels if not laser(c)))


def unseeing(recording: Recording) -> Recording:
    """Return the recording with a laser that never saw the road."""
    channels = (
        replace(c, values=np.full_like(c.values, np.nan)) if laser(c) else c
        for c in recording.channels
    )
    return replace(recording, channels=tuple(channels))


def laser(channel: Channel) -> bool:
    """Tell whether ``channel`` is a height."""
    return channel.id.name == "height"


def as_it_is(recording: Recording) -> Recording:
    return recording


def left_alone(path: Path) -> None:
    """Do nothing."""


@dataclass(frozen=True)
class Damage:
    """What is done to the recording before, or to the file after it is written.

    ``says`` is in the one line that tells about it.
    """

    name: str
    suffixes: tuple[str, ...]
    says: str
    before: Callable[[Recording], Recording] = as_it_is
    after: Callable[[Path], None] = left_alone


UNKNOWN = "no adapter recognises it"
BINARY = (".mf4", ".tdms", ".parquet", ".arrow", ".h5", ".blf")
CHECKED = (".parquet", ".h5")
DAMAGES = (
    Damage("truncated", (".arrow", *CHECKED), "copy the complete file again", after=truncated),
    Damage("empty", (*BINARY, ".asc"), UNKNOWN, after=emptied),
    Damage("zeroed head", BINARY, UNKNOWN, after=headless),
    Damage("bytes flipped inside", CHECKED, "no sound", after=flipped),
    Damage("text", BINARY, UNKNOWN, after=text),
    Damage("sample file missing", (DIRECTORY,), "No such file", after=sampleless),
    Damage("broken JSON", (DIRECTORY,), "recording.json: not JSON", after=broken),
    Damage("channel missing", (".csv", ".mf4"), "channel height: missing", before=heightless),
    Damage("wrong unit", (DIRECTORY,), "unit 'kg', expected 'm'", after=unlike),
    Damage("all NaN", (".mf4", ".parquet"), "samples are missing (100 %)", before=unseeing),
)
