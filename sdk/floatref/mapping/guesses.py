"""What a native channel may be, from its name and its unit."""

import re
from typing import NamedTuple

from floatref.mapping.ours import channel_of
from floatref.mapping.units import known_unit
from floatref.values.native import Column

TRACKS = {
    "left": r"left|links|lwp|gauche|izq|\bl\b|\bli\b|\blh\b",
    "right": r"right|rechts|rwp|droite|derech|\br\b|\bre\b|\brh\b",
    "center": r"cent(er|re)|mid(dle)?|mitte|\bc\b",
}
"""Words for the wheel paths."""
AXIS = r"\b(a|w|acc(el)?|gyro?|om(ega)?)?"
"""What may stand before the letter of an axis, in one word with it."""
GNSS = (
    r"gps|gnss|gga|\bgns\b|vtg|rmc|gll|pashr|nav\b|(best|psr|rtk|ppp)\w*(pos|vel|utm)"
    r"|\bins(pva|pos|vel|att)?[sx]?\b"
)
"""Words for a receiver, in the name of a stream or of a channel."""
PLACE = r"\blat(itude)?\b|\blong?(itude)?\b|\balt(itude)?\b"
"""Words for a place, if the unit is that of an angle or a length."""
ABOUT = r"geoid|undulation|std|stdev|sigma|\bsd\b|variance|accuracy|dop\b|\bage\b|temp"
"""Words for what is known about a channel, rather than the channel."""
TURNING = r"gyr|rate|omega"
"""Words for an angular rate where there is no unit."""
QUANTITIES = (
    ("gnss_latitude", "rad", r"\blat(itude)?\b|breite"),
    ("gnss_longitude", "rad", r"\blong?(itude)?\b|l.nge"),
    ("gnss_quality", "1", r"qual"),
    ("gnss_vertical_velocity", "m/s", r"(vert|up|climb|\bd\b).*(vel|speed|spd)|vel.*(up|vert)|^z$"),
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
    ("distance", "1", r"dmi|odo|encoder|pulse.?count|counts"),
    ("longitudinal_specific_force", "m/s^2", rf"\blong|{AXIS}x\b|fwd|forward|surge"),
    ("lateral_specific_force", "m/s^2", rf"\blat(eral)?\b|{AXIS}y\b|sway"),
    ("vertical_specific_force", "m/s^2", rf"acc|vert|{AXIS}z\b|heave|beschl"),
    ("roll_rate", "rad/s", rf"roll|{AXIS}x\b"),
    ("pitch_rate", "rad/s", rf"pitch|nick|{AXIS}y\b"),
    ("yaw_rate", "rad/s", rf"yaw|gier|{AXIS}z\b|head"),
)
"""Channels, the SI unit they come in, and words for them, the more particular first."""


class Guess(NamedTuple):
    """A channel and a wheel path, and whether the unit speaks for it, too."""

    channel: str
    track: str | None
    sure: bool


def guess(stream: str, column: Column) -> Guess | None:
    """Return what ``column`` of ``stream`` may be, None if nothing speaks for a channel."""
    if not column.numeric:
        return None
    ours, receiver = channel_of(column), bool(re.search(GNSS, _words(stream)))
    # What a receiver calls height is no range to the road.
    if ours is not None and (ours[0].startswith("gnss_") or not receiver):
        return Guess(*ours, sure=True)
    words = _words(column.name)
    if re.search(ABOUT, words):
        return None
    unit = known_unit(column.unit)
    si = unit.si if unit is not None else "rad/s" if re.search(TURNING, words) else None
    gnss = receiver or bool(re.search(GNSS, words))
    gnss = gnss or (si in (None, "rad", "m") and bool(re.search(PLACE, words)))
    for channel, usual, pattern in QUANTITIES:
        if channel.startswith("gnss_") != gnss or si not in (None, usual):
            continue
        if re.search(pattern, words):
            track = None if channel.startswith(("gnss_", "distance")) else _track(words)
            alone = usual == "1" and gnss and not column.unit.strip()
            return Guess(channel, track, sure=unit is not None or alone)
    return None


def _words(name: str) -> str:
    """Return ``name`` in lower case, its words apart."""
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])|[_./\\\-\[\]()0-9]+", " ", name)
    return apart.lower()


def _track(words: str) -> str | None:
    return next((name for name, pattern in TRACKS.items() if re.search(pattern, words)), None)
