"""The words of a native name, and the wheel path in them."""

import re

TRACKS = {
    "left": r"left|links|lwp|gauche|izq|\bl\b|\bli\b|\blh\b|\b(fl|rl|lf|lr|vl|hl)\b",
    "right": r"right|rechts|rwp|droite|derech|\br\b|\bre\b|\brh\b|\b(fr|rr|rf|vr|hr)\b",
    "center": r"cent(er|re)|mid(dle)?|mitte|\bc\b",
}
"""Words for the wheel paths; a corner of the vehicle is on one, too."""
AXIS = r"\b(a|w|acc(el)?|gyro?|om(ega)?)?"
"""Prefixes of the letter of an axis, in one word with it."""
LONGITUDINAL = rf"\blong|{AXIS}x\b|fwd|forward|surge"
LATERAL = rf"\blat(eral)?\b|{AXIS}y\b|sway"
CORNER = r"\b(FL|FR|RL|RR)(?=[A-Z][a-z])"
"""A corner of the vehicle as prefix, as in FLAcc."""


def words_of(name: str) -> str:
    """Return ``name`` in lower case, its words apart."""
    apart = re.sub(CORNER, r"\1 ", re.sub(r"[_./\\\-\[\]()0-9]+", " ", name))
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", apart).lower()
    return re.sub(r"\b(fl|fr|rl|rr)([xyz])\b", r"\1 \2", apart)


def track_of(words: str) -> str | None:
    """Return the wheel path named in ``words``, None if they name no wheel path."""
    return next((name for name, pattern in TRACKS.items() if re.search(pattern, words)), None)
