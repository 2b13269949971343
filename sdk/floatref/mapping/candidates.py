"""What the columns of a file may be, each beside the others."""

import re
from typing import NamedTuple

from floatref.mapping.guesses import Guess, guess
from floatref.mapping.ours import channel_of
from floatref.mapping.response_guesses import BODY
from floatref.mapping.words import words_of
from floatref.values.native import Column, NativeFile, Stream

WHEELS = ("unsprung_", "suspension_")
"""How channels of the front, or only, axle begin."""


class Candidate(NamedTuple):
    """A column and what it may be."""

    stream: Stream
    column: Column
    guess: Guess | None


def candidates(native: NativeFile) -> tuple[Candidate, ...]:
    """Return every column of ``native`` in order, with what it may be.

    Where wheels are measured and no height is, the accelerometer of the body is that of a sprung
    mass, not of a profiler; a rear axle that is the only one has the channels of that.
    """
    alone = [Candidate(s, c, guess(s.name, c)) for s in native.streams for c in s.columns]
    held = {c.guess.channel for c in alone if c.guess is not None}
    return tuple(_beside(candidate, held) for candidate in alone)


def _beside(candidate: Candidate, held: set[str]) -> Candidate:
    found, named = candidate.guess, channel_of(candidate.column) is not None
    if found is None or named:
        return candidate
    channel = found.channel.removeprefix("rear_")
    front = any(name.startswith(WHEELS) for name in held)
    if channel != found.channel and not front:
        return candidate._replace(guess=found._replace(channel=channel))
    wheels = any(name.removeprefix("rear_").startswith("unsprung_") for name in held)
    if channel == "vertical_specific_force" and wheels and "height" not in held:
        words = f"{words_of(candidate.stream.name)} {words_of(candidate.column.name)}"
        if re.search(BODY, words):
            return candidate._replace(guess=found._replace(channel="sprung_specific_force"))
    return candidate
