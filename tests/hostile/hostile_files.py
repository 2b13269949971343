"""Hostile files: what is no file in place of one, damaged native files, names with controls."""

import json
import os
import random
import socket
from collections.abc import Callable
from pathlib import Path

import numpy as np

from floatref import Channel, Profile, ProfileTrack, Recording, UniformClock
from floatref import write_profile as write_profile
from floatref import write_recording as write_recording
from floatref_adapters.testing import WRITERS

CAN = "date Mon Jan 1 00:00:00 2024\nbase hex timestamps absolute\n0.1 1 123 Rx d 2 00 01\n"
CONTROLS = "a\x1b[31m\nb\x07"
"""A name that would colour a terminal, break a line and ring."""
HUGE = (b"\xff" * 8, b"\xff\xff\xff\x7f" * 2, bytes(8), b"\xfe\xff\xff\xff\x0f\xff\xff\x0f")
"""What overwrites eight bytes: sizes beyond any file, as several formats write them."""


def make_pipe(path: Path) -> None:
    """Make a pipe that nobody writes to."""
    os.mkfifo(path)


def make_socket(path: Path) -> None:
    """Make a socket; its path may be long, its name in the current folder may not."""
    here = os.getcwd()
    os.chdir(path.parent)
    try:
        with socket.socket(socket.AF_UNIX) as bound:
            bound.bind(path.name)
    finally:
        os.chdir(here)


KINDS: dict[str, Callable[[Path], None]] = {
    "pipe": make_pipe,
    "socket": make_socket,
    "loop": lambda path: path.symlink_to(path),
    "chain": lambda path: path.symlink_to(path.with_name("gone")),
    "zero": lambda path: path.symlink_to("/dev/zero"),
    "null": lambda path: path.symlink_to("/dev/null"),
    "terminal": lambda path: path.symlink_to("/dev/tty"),
    "unsized": lambda path: path.symlink_to("/proc/self/environ"),
    "folder": lambda path: path.mkdir(),
    "empty": lambda path: path.touch(),
    "byte": lambda path: path.write_bytes(b"x") and None,
    "zeros": lambda path: path.write_bytes(bytes(5000)) and None,
    "deep": lambda path: path.write_text("[" * 200_000, encoding="ascii") and None,
    "long line": lambda path: path.write_bytes(b"1," * (1 << 20)) and None,
}
"""What stands in place of a file, by name."""
REPORT = {
    "format": "conformance-report/1",
    "edition": "2026.2",
    "device": dict.fromkeys(("spec", "name", "version"), "firmware")
    | {"architecture": "temporal", "capabilities": []},
    "class": "nominal",
    "class_reached": None,
    "seed": 0,
    "effort": "quick",
    "verdict": "INCOMPLETE",
    "checks": [],
    "replayed": [],
}
"""A report of the judge without checks."""
IN_PLACE_OF_A_TARGET = ("pipe", "socket", "loop", "zero", "terminal", "folder")
"""Those over which nothing may be written."""


def write_sound(folder: Path) -> dict[str, Path]:
    """Write the sound files of the words of `attacked_commands` into ``folder``."""
    count, clock = 4000, UniformClock.of(1000.0)
    time = np.arange(count) / 1000.0
    recording = Recording(
        (
            Channel.of("vertical_specific_force", 9.8 + 0.1 * np.sin(9.0 * time), clock, "left"),
            Channel.of("height", 0.3 + 0.01 * np.sin(7.0 * time), clock, "left"),
            Channel.of("distance", 20.0 * time, clock),
        )
    )
    write_recording(recording, folder / "run")
    track = ProfileTrack.of("left", 0.01 * np.sin(np.arange(4000) / 9.0))
    write_profile(Profile(0.05, (track,)), folder / "profile")
    rows = "".join(f"{t},{20.0 * t}\n" for t in time[:200])
    (folder / "table.csv").write_text(f"time_s,distance\n{rows}", encoding="ascii")
    (folder / "can.asc").write_text(CAN, encoding="ascii")
    (folder / "report.json").write_text(json.dumps(REPORT), encoding="ascii")
    for suffix, write in WRITERS.items():
        write(recording, folder / f"native{suffix}", None)
    names = {"run": "run", "profile": "profile", "csv": "table.csv", "can": "can.asc"}
    names["report"] = "report.json"
    return {name: folder / file for name, file in names.items()}


def damage(sound: bytes, draw: random.Random) -> tuple[str, bytes]:
    """Return what was done to ``sound``, and the result."""
    how = draw.choice(["cut", "overwritten", "huge", "doubled"])
    at = draw.randrange(max(len(sound) - 8, 1))
    if how == "cut":
        return how, sound[:at]
    if how == "doubled":
        return how, sound[:at] + sound
    new = draw.choice(HUGE) if how == "huge" else draw.randbytes(draw.choice((1, 2, 4, 8)))
    return how, sound[:at] + new + sound[at + len(new) :]
