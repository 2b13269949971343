"""What `floatref live` answers: each answer has a kind and a body of plain JSON values."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from floatref.live.points import LivePoints
from floatref.live.session.messages import FORMAT
from floatref.live.stream import LiveStream
from floatref.version import __version__


@dataclass(frozen=True)
class Answer:
    """One answer.

    Attributes:
        kind: started, points, event, saved, refused or finished.
        body: its other keys.
        points: of the kind points, whose arrays are not in the body.
    """

    kind: str
    body: Mapping[str, Any] = field(default_factory=dict)
    points: LivePoints | None = None


def started(
    stream: LiveStream, interval_m: float, tracks: tuple[str, ...], state: Mapping[str, Any]
) -> Answer:
    """Return the answer to a hello; ``state`` is that of `saved`."""
    body = {
        "format": FORMAT,
        "floatref": __version__,
        "pipelines": list(stream.pipelines),
        "interval_m": interval_m,
        "tracks": list(tracks),
        "latency": asdict(stream.latency),
    }
    return Answer("started", {**body, **state})


def of_points(points: LivePoints) -> list[Answer]:
    """Return ``points``, if there are any, and their events as answers."""
    if not len(points):
        return [event(text) for text in points.events]
    events = [Answer("event", {"text": text, "first": points.first}) for text in points.events]
    body = {
        "state": str(points.state),
        "first": points.first,
        "interval_m": points.interval_m,
        "pipeline": points.pipeline,
    }
    return [*events, Answer("points", body, points)]


def event(text: str) -> Answer:
    """Return the answer that something happened at no place of its own."""
    return Answer("event", {"text": text, "first": None})


def saved(state: Mapping[str, Any]) -> Answer:
    """Return the answer that all samples before ``state["next"]`` are on the disk."""
    return Answer("saved", state)


def refused(error: Exception) -> Answer:
    """Return the answer to a message that cannot be used."""
    return Answer("refused", {"text": str(error)})


def finished(directory: Path, points: int, interval_m: float) -> Answer:
    """Return the last answer: the profile is complete."""
    length_m = max(points - 1, 0) * interval_m
    return Answer("finished", {"profile": str(directory), "points": points, "length_m": length_m})
