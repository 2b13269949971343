"""Guesses of the channel of a native column, from its name and its unit."""

import re
from typing import NamedTuple

from floatref.mapping.channel_map.column_names import channel_of
from floatref.mapping.channel_map.units import known_unit
from floatref.mapping.draft.name_words import AXIS, LATERAL, LONGITUDINAL, track_of, words_of
from floatref.mapping.draft.response_guesses import BODY, Response, response
from floatref.values.native import Column, NativeFile, Stream

GNSS = (
    r"gps|gnss|gga|\bgns\b|vtg|rmc|gll|pashr|nav\b|(best|psr|rtk|ppp)\w*(pos|vel|utm)"
    r"|\bins(pva|pos|vel|att)?[sx]?\b"
)
"""Words for a receiver, in the name of a stream or of a channel."""
PLACE = r"\blat(itude)?\b|\blong?(itude)?\b|\balt(itude)?\b"
"""Words for a place, if the unit is that of an angle or a length."""
ABOUT = r"geoid|undulation|std|stdev|sigma|\bsd\b|variance|accuracy|dop\b|\bage\b|temp"
"""Words for properties of a channel, rather than the channel."""
TURNING = r"gyr|rate|omega"
"""Words for an angular rate where there is no unit."""
EITHER = r"\bride\b|\blevel"
"""Words for a height over the road or over the axle, where the name says height."""
QUANTITIES = (
    ("gnss_latitude", "rad", r"\blat(itude)?\b|breite"),
    ("gnss_longitude", "rad", r"\blong?(itude)?\b|l.nge"),
    ("gnss_quality", "1", r"qual"),
    ("gnss_vertical_velocity", "m/s", r"(vert|up|climb|\bd\b).*(vel|speed|spd)|vel.*(up|vert)|^z$"),
    ("gnss_speed", "m/s", r"speed|\bspd\b|\bsog\b"),
    ("gnss_height", "m", r"\balt|ellips|height|\bhgt\b"),
    ("gnss_pitch", "rad", r"pitch"),
    ("gnss_roll", "rad", r"roll"),
    (
        "height",
        "m",
        r"laser|\blas\b|height|\bhgt|range|gocator|selcom|optocator|h(oe|.)he|texture",
    ),
    ("distance", "m", r"dist|dmi|odo|encoder|station|chain|weg\b|position"),
    ("distance", "m/s", r"speed|\bspd\b|\bvel|geschw|\bv\b"),
    ("distance", "1", r"dmi|odo|encoder|pulse.?count|counts|wheel ?(pulse|tick)"),
    ("longitudinal_specific_force", "m/s^2", LONGITUDINAL),
    ("lateral_specific_force", "m/s^2", LATERAL),
    ("vertical_specific_force", "m/s^2", rf"acc|vert|{AXIS}z\b|heave|beschl"),
    ("roll_rate", "rad/s", rf"roll|{AXIS}x\b"),
    ("pitch_rate", "rad/s", rf"pitch|nick|{AXIS}y\b"),
    ("yaw_rate", "rad/s", rf"yaw|gier|{AXIS}z\b|head"),
)
"""Channels, the SI unit they come in, and words for them, the more particular first."""


class Guess(NamedTuple):
    """A channel and a wheel path, and whether the unit confirms it."""

    channel: str
    track: str | None
    sure: bool


def guess(stream: str, column: Column) -> Guess | None:
    """Return the guess for ``column`` of ``stream``, None without evidence for a channel."""
    if not column.numeric:
        return None
    ours, receiver = channel_of(column), bool(re.search(GNSS, words_of(stream)))
    # What a receiver calls height is no range to the road.
    if ours is not None and (ours[0].startswith("gnss_") or not receiver):
        return Guess(*ours, sure=True)
    words = words_of(column.name)
    if re.search(ABOUT, words):
        return None
    unit = known_unit(column.unit)
    si = unit.si if unit is not None else "rad/s" if re.search(TURNING, words) else None
    gnss = receiver or bool(re.search(GNSS, words))
    gnss = gnss or (si in (None, "rad", "m") and bool(re.search(PLACE, words)))
    if not gnss and (found := response(words_of(stream), words, si)) is not None:
        return _guess_response(found, stream, words, known=unit is not None)
    for channel, usual, pattern in QUANTITIES:
        if channel.startswith("gnss_") != gnss or si not in (None, usual):
            continue
        if re.search(pattern, words):
            track = None if channel.startswith(("gnss_", "distance")) else track_of(words)
            alone = usual == "1" and gnss and not column.unit.strip()
            either = channel == "height" and bool(re.search(EITHER, words))
            return Guess(channel, track, sure=(unit is not None or alone) and not either)
    return None


def _guess_response(found: Response, stream: str, words: str, known: bool) -> Guess | None:
    if found.channel is None:
        return None
    shared = found.channel.startswith(("pitch", "roll"))
    track = None if shared else track_of(words) or track_of(words_of(stream))
    return Guess(found.channel, track, sure=known and not found.doubtful)


WHEELS = ("unsprung_", "suspension_")
"""How channels of the front, or only, axle begin."""


class Candidate(NamedTuple):
    """A column and its guess."""

    stream: Stream
    column: Column
    guess: Guess | None


def candidates(native: NativeFile) -> tuple[Candidate, ...]:
    """Return every column of ``native`` in order, with its guess.

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
