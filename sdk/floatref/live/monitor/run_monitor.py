"""The model behind the views: an observer of a live run, whose memory does not grow.

The thread that serves the run calls it; views ask for what is `shown` from threads of their own.
A view copies under the lock and computes outside, so that no view makes the run wait.
"""

import time
from collections import deque
from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import replace
from functools import wraps
from threading import Lock
from typing import Concatenate, ParamSpec

from floatref.live.monitor.sections import BEFORE, SECTION_M, SHOWN, Sections, newest
from floatref.live.monitor.sensor_health import Health, SensorHealth, SensorState
from floatref.live.monitor.shown_state import Event, Shown, Status, ToFinal
from floatref.live.points import LivePoints, State
from floatref.live.session.messages import Piece
from floatref.live.session.watch import Taken, Watch
from floatref.live.stream import LiveStream
from floatref.stages.signals import DISTANCE
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack

EVENTS = 10
"""Events that are held."""
LONGEST_TEXT = 400
"""Characters of an event that are held."""
SET_BACK_M = 1.0
"""A distance set back by more than this, in m, goes on from where it was."""
P = ParamSpec("P")


def _harmless(
    call: Callable[Concatenate["RunMonitor", P], None],
) -> Callable[Concatenate["RunMonitor", P], None]:
    """Return ``call`` under the lock; what fails in a display is shown, and never ends a run."""

    @wraps(call)
    def safe(monitor: "RunMonitor", /, *args: P.args, **kwargs: P.kwargs) -> None:
        with monitor._lock:
            try:
                call(monitor, *args, **kwargs)
            except Exception as error:
                monitor._fault = f"{type(error).__name__}: {error}"[:LONGEST_TEXT]

    return safe


class RunMonitor(Watch):
    """Follows one run."""

    def __init__(self, name: str, clock: Callable[[], float] = time.monotonic) -> None:
        """Follow the run called ``name``; ``clock`` gives the time of this machine in s."""
        self._name, self._clock, self._begun_s = name, clock, clock()
        self._lock = Lock()
        self._stream: LiveStream | None = None
        self._status, self._reason, self._fault = Status.WAITING, "", ""
        self._sensors: dict[str, SensorHealth] = {}
        self._distance_m: float | None = None
        self._speed_mps: float | None = None
        self._begin_m: float | None = None
        self._offset_m = 0.0
        self._final, self._provisional = Sections(True), Sections(False)
        self._newest_m: float | None = None
        self._final_m: float | None = None
        self._interval_m = 0.0
        self._events: deque[Event] = deque(maxlen=EVENTS)
        self._counted = 0
        self._waits_since_s: float | None = None

    @_harmless
    def recall(self, profile: Profile) -> None:
        """Take the final points that are stored, of a run that is resumed."""
        interval_m, count = profile.interval_m, profile.tracks[0].elevation.size
        origin = round(profile.start_m / interval_m)
        number = max(int((count - 1) * interval_m / SECTION_M) - SHOWN, 0)
        before = round(max(number - BEFORE, 0) * SECTION_M / interval_m)
        self._final.begin(origin, number)
        tracks = tuple(_rest(track, before) for track in profile.tracks)
        self._give(LivePoints(origin + before, interval_m, tracks, State.FINAL))

    @_harmless
    def declared(self, clocks: Mapping[str, UniformClock | None]) -> None:
        """Begin to count the samples of these channels."""
        self._sensors = {name: SensorHealth(name, clock) for name, clock in clocks.items()}

    @_harmless
    def started(self, stream: LiveStream) -> None:
        """See that a program is connected."""
        self._stream = stream
        self._status, self._reason = Status.RUNNING, ""

    @_harmless
    def read(self, pieces: Mapping[str, Piece]) -> None:
        """Count samples."""
        now_s = self._clock()
        for name, piece in pieces.items():
            self._sensors[name].read(piece, now_s)

    @_harmless
    def missed(self, name: str, count: int) -> None:
        """Count samples that were never sent."""
        self._sensors[name].drop(count)

    @_harmless
    def took(self, taken: Taken) -> None:
        """Take distance and speed."""
        if taken.distance_m is None:
            return
        at_m = taken.distance_m + self._offset_m
        if self._distance_m is not None and at_m < self._distance_m - SET_BACK_M:
            self._offset_m += self._distance_m - at_m
            at_m = self._distance_m
        self._begin_m = at_m if self._begin_m is None else self._begin_m
        self._distance_m, self._speed_mps = at_m, taken.speed_mps

    @_harmless
    def waited(self, begins: bool) -> None:
        """See that no message is read: channels are not silent meanwhile."""
        self._waits_since_s = self._clock() if begins else None

    @_harmless
    def gave(self, points: LivePoints) -> None:
        """Take points and their events."""
        for text in points.events:
            self._note(text, points.first * points.interval_m if len(points) else None)
        if len(points):
            self._give(points)

    @_harmless
    def event(self, text: str) -> None:
        """Take one line."""
        self._note(text, None)

    @_harmless
    def completed(self) -> None:
        """Finish the last section."""
        self._status = Status.COMPLETE
        self._final.close()

    @_harmless
    def ended(self, text: str) -> None:
        """Take why the connection has ended."""
        self._waits_since_s = None
        if self._status is not Status.COMPLETE:
            self._status, self._reason = Status.INTERRUPTED, text[:LONGEST_TEXT]

    def shown(self) -> Shown:
        """Return what there is to show now."""
        with self._lock:
            shown, newest_points = self._shown(self._clock()), copy(self._newest())
        return replace(shown, running=newest_points.running())

    def _shown(self, now_s: float) -> Shown:
        """Return all but the section that grows."""
        waits_s = None if self._waits_since_s is None else now_s - self._waits_since_s
        sensors = self._states(now_s - (waits_s or 0.0))
        return Shown(
            name=self._name,
            status=self._status,
            reason=self._reason,
            pipeline="" if self._stream is None else self._stream.pipelines[0],
            for_s=now_s - self._begun_s,
            calculates_s=waits_s,
            distance_m=self._distance_m,
            speed_mps=self._known_speed(sensors),
            final_m=self._final_m,
            to_final=self._to_final(),
            sensors=sensors,
            sections=tuple(newest(self._final, self._provisional)),
            running=None,
            events=tuple(self._events),
            fault=self._fault,
        )

    def _note(self, text: str, at_m: float | None) -> None:
        self._counted += 1
        self._events.append(Event(self._counted, text[:LONGEST_TEXT], at_m))

    def _give(self, points: LivePoints) -> None:
        last_m = (points.first + len(points) - 1) * points.interval_m
        self._newest_m = last_m if self._newest_m is None else max(last_m, self._newest_m)
        self._interval_m = points.interval_m
        if points.state is State.PROVISIONAL:
            self._provisional.add(points)
            return
        self._final.add(points)
        self._final_m = last_m
        if self._final.origin is not None:
            self._provisional.realign(self._final.origin)

    def _newest(self) -> Sections:
        """Return the sections with the newest points; copied, they change no more."""
        reached = self._provisional.end, self._final.end
        if self._status is Status.COMPLETE or reached[0] is None:
            return self._final
        return self._provisional if reached[1] is None or reached[0] > reached[1] else self._final

    def _states(self, now_s: float) -> tuple[SensorState, ...]:
        late = {} if self._stream is None else self._stream.late
        return tuple(
            each.state(now_s, late.get(name, 0), self._speed_mps)
            for name, each in self._sensors.items()
        )

    def _known_speed(self, sensors: tuple[SensorState, ...]) -> float | None:
        """Return the speed in m/s; None where the distance is silent, so that it is not known."""
        silent = any(
            each.name.rpartition(".")[2] == DISTANCE and each.health is Health.SILENT
            for each in sensors
        )
        return None if silent else self._speed_mps

    def _to_final(self) -> ToFinal | None:
        """Return when the next point is final; None once all are, and before there is a place."""
        if self._stream is None or self._begin_m is None or self._status is Status.COMPLETE:
            return None
        latency = self._stream.latency
        place_m = self._begin_m if self._final_m is None else self._final_m + self._interval_m
        # Points lie on the stream's own axis, which a stream that goes on may have moved.
        here_m = max(m for m in (self._distance_m, self._newest_m) if m is not None)
        return ToFinal(place_m, max(place_m + latency.travelled_m - here_m, 0.0), latency)


def _rest(track: ProfileTrack, first: int) -> ProfileTrack:
    sigma = None if track.sigma is None else track.sigma[first:]
    return ProfileTrack(track.name, track.elevation[first:], track.valid[first:], sigma)
