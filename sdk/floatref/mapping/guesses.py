"""What a native channel may be, from its name and its unit."""

import re
from typing import NamedTuple

from floatref.mapping.ours import channel_of
from floatref.mapping.units import known_unit
from floatref.values.native import Column

TRACKS = {
    "left": r"left|links|lwp|gauche|izq|\bl\b|\bli\b|\blh\b",
    "right": r"right|rechts|rwp|droite|der\b|\br\b|\bre\b|\brh\b",
    "center": r"cent(er|re)|mid(dle)?|mitte|\bc\b",
}
"""Words for the wheel paths."""
QUANTITIES = (
    ("gnss_latitude", "rad", r"lat(itude)?\b|breite"),
    ("gnss_longitude", "rad", r"lon(g|gitude)?\b|l.nge"),
    ("gnss_quality", "1", r"qual|\bfix\b|solution|pos ?type"),
    ("gnss_vertical_velocity", "m/s", r"(vert|up|climb|\bd\b).*(vel|speed|spd)|vel.*(up|vert)"),
    ("gnss_height", "m", r"alt|ellips|\bhgt\b|(gps|gnss|gga|bestpos|ins\w*).*height"),
    ("gnss_pitch", "rad", r"pitch"),
    ("gnss_roll", "rad", r"roll"),
    ("distance", "m", r"dist|dmi|odo|encoder|station|chain|weg\b|position"),
    ("distance", "m/s", r"speed|vel|geschw|v\b"),
    ("distance", "1", r"dmi|odo|encoder|pulse.?count|counts"),
    ("height", "m", r"laser|height|range|hoehe|h.he|optocator|texture"),
    ("longitudinal_specific_force", "m/s^2", r"long|\bx\b|[_ ]?a?x\b|fwd|forward|surge"),
    ("lateral_specific_force", "m/s^2", r"lateral|\by\b|a?y\b|sway"),
    ("vertical_specific_force", "m/s^2", r"acc|vert|\bz\b|a?z\b|heave|beschl"),
    ("roll_rate", "rad/s", r"roll|\bx\b|w?x\b"),
    ("pitch_rate", "rad/s", r"pitch|nick|\by\b|w?y\b"),
    ("yaw_rate", "rad/s", r"yaw|gier|\bz\b|w?z\b|head"),
)
"""Channels, the SI unit they come in, and words for them, the more particular first."""
FEW = {"m/s^2", "rad/s"}
"""Units that alone tell what a channel is, if not which."""


class Guess(NamedTuple):
    """A channel and a wheel path, and whether the unit speaks for it, too."""

    channel: str
    track: str | None
    sure: bool


def guess(stream: str, column: Column) -> Guess | None:
    """Return what ``column`` of ``stream`` may be, None if nothing speaks for a channel."""
    if not column.numeric:
        return None
    ours = channel_of(column)
    if ours is not None:
        return Guess(*ours, sure=True)
    words = _words(column.name)
    unit = known_unit(column.unit) if column.unit else None
    gnss = bool(re.search(r"gps|gnss|gga|pos|vel|ins|rmc|nav", _words(stream)))
    for channel, si, pattern in QUANTITIES:
        if channel.startswith("gnss_") != gnss and not re.search("lat|lon|alt", words):
            continue
        if (unit is None or unit.si == si) and re.search(pattern, words):
            track = None if channel.startswith(("gnss_", "distance")) else _track(words)
            return Guess(channel, track, sure=unit is not None)
    return None


def _words(name: str) -> str:
    """Return ``name`` in lower case, its words apart."""
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])|[_./\\\-\[\]()0-9]+", " ", name)
    return apart.lower()


def _track(words: str) -> str | None:
    return next((name for name, pattern in TRACKS.items() if re.search(pattern, words)), None)
