"""Guesses of native channels of the vehicle's response: wheels, body and suspension."""

import re
from collections.abc import Callable
from typing import NamedTuple

from floatref.mapping.draft.name_words import AXIS, LATERAL, LONGITUDINAL

BODY = r"\bbody|chassis|\bframe\b|cabin|aufbau|karosser|\babove\b|\bover\b"
"""Words for the body, whose accelerometer is a profiler's own as well."""
WHEEL = r"axle|\bhubs?\b|wheel(?! ?(path|track))|knuckle|upright|spindle|achs|radtr|radnabe"
PLACES = (
    ("unsprung", r"\bun ?sprung"),
    ("sprung", r"(?<!un )\bsprung"),
    ("equipment", r"equip|payload"),
    ("body", BODY),
    ("wheel", WHEEL),
)
"""Where a sensor is, and words for it, the more particular first."""
MASSES = {"wheel": "unsprung", "body": "sprung"}
"""Names of the channels of a place, where they differ from the place."""
REAR = r"\brear|\b(rl|rr|lr|hl|hr|ra)\b|hinten|hinter"
SPRING = (
    r"\bsusp(?!ect)|\blvdt|potentiometer|string ?pot|draw ?wire|jounce|federweg|wheel ?travel"
    r"|\b(damper|shock|strut|spring) ?(travel|stroke|pos|disp|defl|length)"
)
"""Words for the suspension, between body and wheel."""
PATH = r"travel|stroke|pos|disp|defl|^ *(fl|fr|rl|rr)? *$"
"""Words for its travel, where the name of the stream alone says what moves."""
ACCELERATION = rf"acc|beschl|vibr|{AXIS}z\b"
HEAVE = rf"(?<!laser )disp|heave|{AXIS}z\b"
"""Words for a displacement; that of a laser is a range."""
RATE = rf"(\bvel|speed).*({AXIS}z\b|vert|up)|({AXIS}z\b|vert).*(\bvel|speed)"
TURNS = (
    ("pitch", r"(pitch|nick).*(acc|beschl)|acc.*pitch", r"pitch.*ang|nickw|body pitch|^ *pitch *$"),
    ("roll", r"(roll|wank).*(acc|beschl)|acc.*roll", r"roll.*ang|wankw|body roll|^ *roll *$"),
)
"""Freedoms that turn, with words for their acceleration and for their angle."""


class Response(NamedTuple):
    """A channel, None for a column of a wheel without a channel; and whether it is doubtful."""

    channel: str | None
    doubtful: bool = False


class _Clues(NamedTuple):
    """Words of the stream and of the column, where the sensor is, whether a unit is known."""

    stream: str
    words: str
    place: str | None
    unit: bool

    @property
    def mass(self) -> str:
        return MASSES.get(self.place or "", self.place or "")

    def say(self, pattern: str) -> bool:
        return bool(re.search(pattern, self.words))


def response(stream: str, words: str, si: str | None) -> Response | None:
    """Return the channel of the response that the ``words`` of a column mean, None if unknown.

    ``stream`` has the words of the stream, which count where the column's own words name no place;
    ``si`` is the SI unit, None if it is unknown.
    """
    clues = _Clues(stream, words, _place(words) or _place(stream), si is not None)
    for unit, rule in RULES:
        found = rule(clues) if si in (None, unit) else None
        if found is not None:
            return _on_axle(found, bool(re.search(REAR, f"{stream} {words}")))
    return None


def _place(words: str) -> str | None:
    return next((name for name, pattern in PLACES if re.search(pattern, words)), None)


def _on_axle(found: Response, rear: bool) -> Response:
    if found.channel is None or not rear or not found.channel.startswith(("unsprung", "susp")):
        return found
    return found._replace(channel=f"rear_{found.channel}")


def _turning(clues: _Clues) -> Response | None:
    for freedom, acceleration, _ in TURNS:
        if clues.say(acceleration):
            return Response(f"{freedom}_acceleration")
    return None


def _force(clues: _Clues) -> Response | None:
    """Return the accelerometer; that of the body is guessed with those of a profiler."""
    if clues.place == "body" or not (clues.unit or clues.say(ACCELERATION)):
        return None
    if clues.place is None:
        between = re.search(SPRING, f"{clues.stream} {clues.words}")
        return Response("unsprung_specific_force", doubtful=True) if between else None
    if clues.say(LONGITUDINAL) or clues.say(LATERAL):
        return Response(None)
    return Response(f"{clues.mass}_specific_force")


def _velocity(clues: _Clues) -> Response | None:
    if not clues.say(r"\bvel|speed"):
        return None
    if clues.say(rf"{SPRING}|\b(damper|shock|strut)"):
        return Response(None)
    if clues.place is None or (clues.place in MASSES and not clues.say(RATE)):
        return None
    return Response(f"{clues.mass}_velocity")


def _deflection(clues: _Clues) -> Response | None:
    named = clues.say(SPRING) or (re.search(SPRING, clues.stream) and clues.say(PATH))
    return Response("suspension_deflection") if named else None


def _displacement(clues: _Clues) -> Response | None:
    if clues.place is None or not clues.say(HEAVE):
        return None
    return Response(f"{clues.mass}_displacement", doubtful=clues.place in MASSES)


def _angle(clues: _Clues) -> Response | None:
    """Return an angle of the body; doubtful for an attitude, which contains the road."""
    for freedom, _, angle in TURNS:
        if clues.say(angle):
            return Response(f"{freedom}_angle", doubtful=clues.place not in ("body", "sprung"))
    return None


RULES: tuple[tuple[str, Callable[[_Clues], Response | None]], ...] = (
    ("rad/s^2", _turning),
    ("m/s^2", _force),
    ("m/s", _velocity),
    ("m", _deflection),
    ("m", _displacement),
    ("rad", _angle),
)
"""Rules by SI unit, in the order in which they are tried without a unit."""
