"""What the views of a live run show: values at one moment, which nobody changes any more."""

import math
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any

from floatref.live.bounds import Latency
from floatref.live.monitor.sections import Section
from floatref.live.monitor.sensor_health import SensorState


class Status(StrEnum):
    """Where the run is."""

    WAITING = "waiting"
    """No program has sent a hello."""
    RUNNING = "running"
    """A program is connected."""
    INTERRUPTED = "interrupted"
    """The program has gone, or the command was ended; the run is not complete."""
    COMPLETE = "complete"
    """All points were given."""


@dataclass(frozen=True)
class Event:
    """One line about the run.

    Attributes:
        number: of the event, counted from 1.
        text: the line.
        at_m: place of the points that it is about in m; None for an event of no place.
    """

    number: int
    text: str
    at_m: float | None


@dataclass(frozen=True)
class ToFinal:
    """When the next point is final, from the declared latency, and then the time for calculation.

    Attributes:
        place_m: where that point lies, in m on the axis of distance.
        travel_m: what the vehicle goes until then at most, in m.
        latency: as the stream has declared it; it states the seconds at a standstill.
    """

    place_m: float
    travel_m: float
    latency: Latency


@dataclass(frozen=True)
class Shown:
    """A live run at one moment.

    Attributes:
        name: of the run.
        status: where the run is.
        reason: why the connection has ended; empty while it lasts.
        pipeline: what makes the final points; empty before the first hello.
        for_s: time in s since the command was started.
        calculates_s: time in s for which points have been calculated while no message is read; None
            while messages are read.
        distance_m, speed_mps: of the vehicle; None while they are not known.
        final_m: place of the last final point in m; None before the first.
        to_final: when the next one comes; None before the first distance.
        sensors: state of every channel.
        sections: finished sections by distance: final ones, then provisional ones.
        running: the section in which the newest points lie.
        events: the last ones, newest last.
        fault: what has failed in the display itself; empty if all is well.
    """

    name: str
    status: Status
    reason: str
    pipeline: str
    for_s: float
    calculates_s: float | None
    distance_m: float | None
    speed_mps: float | None
    final_m: float | None
    to_final: ToFinal | None
    sensors: tuple[SensorState, ...]
    sections: tuple[Section, ...]
    running: Section | None
    events: tuple[Event, ...]
    fault: str

    @property
    def dropped(self) -> int:
        """Number of samples that were never sent."""
        return sum(each.dropped for each in self.sensors)

    @property
    def late(self) -> int:
        """Number of samples that came too late to count."""
        return sum(each.late for each in self.sensors)

    def document(self) -> dict[str, Any]:
        """Return it as JSON values, None for what is not known."""
        document = {**asdict(self), "dropped": self.dropped, "late": self.late}
        return {key: _without_nan(value) for key, value in document.items()}


def _without_nan(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_without_nan(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
