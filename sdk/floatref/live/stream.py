"""A stream: samples are pushed while the vehicle drives, and a thread makes points of them."""

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, suppress
from pathlib import Path
from threading import Condition, Thread
from typing import Any

from floatref.engine.choosing import AUTO
from floatref.errors import StageError
from floatref.live.bounds import LATE_S, Latency
from floatref.live.declared_channels import Declared, Entrance, Piece, Samples, read_declarations
from floatref.live.following import Following
from floatref.live.gathering import Gathering
from floatref.live.points import LivePoints, carry_events
from floatref.live.saved_state import load_state, save_state
from floatref.live.starting import settle
from floatref.live.warming import warm
from floatref.values.channels import ChannelId
from floatref.values.recording import Setup

WAITING = 1 << 23
"""Most samples that wait for the thread, 64 MB; a push of more waits until half are done."""
Pieces = Mapping[ChannelId, Piece]


class LiveStream(AbstractContextManager["LiveStream"]):
    """Takes samples and gives out points; `start_stream` makes one.

    One thread pushes and reads; another works, until `finish`, `close` or the end of a ``with``.
    """

    def __init__(self, following: Following, entrance: Entrance) -> None:
        """Start the thread that works on ``following``."""
        self._following, self._entrance = following, entrance
        taken = {name: each.taken for name, each in following.held.items()}
        self._gathering = Gathering(following.order.clocks, taken)
        self._changed = Condition()
        self._queue: deque[Pieces | None] = deque()
        self._waiting = 0
        self._busy = self._stopped = self._finished = False
        self._error: BaseException | None = None
        self._points: list[LivePoints] = []
        self._thread = Thread(target=self._work, name="floatref-live", daemon=True)
        self._thread.start()

    @property
    def pipelines(self) -> tuple[str, ...]:
        """Names of the pipelines: the one that is taken, then those where it refuses a window."""
        return self._following.order.pipelines

    @property
    def latency(self) -> Latency:
        """When points are final, and provisional ones there."""
        return self._following.latency

    @property
    def interval_m(self) -> float:
        """Distance between points in m."""
        return self._following.order.interval_m

    @property
    def tracks(self) -> tuple[str, ...]:
        """Names of the wheel paths of the points."""
        return self._following.order.tracks

    @property
    def late(self) -> dict[str, int]:
        """By channel, how many samples came too late since the stream was started or resumed."""
        return {str(name): count for name, count in dict(self._following.late_in_all).items()}

    @property
    def is_open(self) -> bool:
        """Whether it takes samples."""
        return not (self._finished or self._stopped)

    def push(self, samples: Mapping[Any, Samples]) -> None:
        """Take the next samples of some channels, by name, such as "left.height".

        A channel with a rate has its samples, shape (N,), in SI units, NaN for missing ones; one
        without has (times in s, samples). Each channel has its own order, and may be late. Samples
        are copied, and go to the thread every half second of theirs. Where too many samples are
        in the queue, it waits until half of them are done.

        Raises InputError for samples that cannot be used, and then takes no sample of the push;
        StageError after `finish` or `close`; and any error of the thread.
        """
        if self.take_whole(samples):
            self.hand_over()

    def take_whole(self, samples: Mapping[Any, Samples]) -> bool:
        """Take ``samples`` as `push` does, without a wait; return whether `hand_over` is due."""
        self._check_open("push")
        return self._gathering.take(samples, self._entrance)

    def ready(self, wait: bool = False) -> list[LivePoints]:
        """Return the points made since the last call, in order; with ``wait``, of all pushes.

        Raises any error of the thread.
        """
        taken, points = carry_events(self.peek(wait))
        self.forget(taken)
        return points

    def peek(self, wait: bool = False) -> list[LivePoints]:
        """Return all that is there, events without points too; it stays there until `forget`."""
        if wait and self.is_open:
            self.hand_over()
        with self._changed:
            if wait:
                self._changed.wait_for(self._is_idle)
            self._raise_error()
            return list(self._points)

    def forget(self, points: Sequence[LivePoints]) -> None:
        """Remove ``points``, which `peek` has returned."""
        del self._points[: len(points)]

    def finish(self) -> list[LivePoints]:
        """End the run: return what `ready` would, and the points of the last window.

        Raises StageError the second time; any error of the thread; InputError if the pipeline has
        refused every window.
        """
        self._check_open("finish")
        self.hand_over()
        with self._changed:
            self._queue.append(None)
            self._finished = True
            self._changed.notify_all()
        self._join()
        return self.ready()

    def save(self, path: Path | str) -> None:
        """Write to ``path``, a file, what the final points of all further pushes depend on.

        It waits for the thread. Points that are ready are not in it: read them before. A stream
        that `resume_stream` makes of it gives the same final points, bit for bit.

        Raises StageError after the end; any error of the thread; InputError if it cannot write.
        """
        self._check_open("save")
        self.hand_over()
        with self._changed:
            self._changed.wait_for(self._is_idle)
            self._raise_error()
            save_state(Path(path), self._following, self._entrance)

    def close(self) -> None:
        """End the thread; what is not final is lost. Does nothing after `finish`."""
        with self._changed:
            self._stopped = True
            self._queue.clear()
            self._changed.notify_all()
        self._join()

    def _join(self) -> None:
        """Wait for the thread, whose lock a signal at the end of a `with` may have left here."""
        with suppress(RuntimeError):
            while True:
                self._changed.release()
        self._thread.join()

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()

    def hand_over(self) -> None:
        """Give the thread what was pushed since the last time; wait where it has too much."""
        count = self._gathering.size
        if not count:
            return
        with self._changed:
            if self._waiting and self._waiting + count > WAITING:
                # Woken for each piece that leaves, it would share the interpreter all the time.
                self._changed.wait_for(lambda: self._waiting <= WAITING // 2 or self._error)
            self._raise_error()
            self._changed.notify_all()
            self._gathering.append_whole(self._queue)
            self._waiting += count

    def _is_idle(self) -> bool:
        return self._error is not None or not (self._queue or self._busy)

    def _check_open(self, call: str) -> None:
        self._raise_error()
        if not self.is_open:
            raise StageError(f"{call}: the stream has ended; start another one")

    def _raise_error(self) -> None:
        if self._error is not None:
            raise self._error

    def _work(self) -> None:
        try:
            while self._work_once():
                pass
        except BaseException as error:
            self._error = error
            self._queue.clear()
        with self._changed:
            self._busy = False
            self._changed.notify_all()

    def _work_once(self) -> bool:
        """Process what was pushed next; return whether there is more to come."""
        with self._changed:
            self._busy = False
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._queue or self._stopped)
            if self._stopped:
                return False
            pieces, self._busy = self._queue.popleft(), True
        for points in self._process(pieces):
            self._points.append(points)
        return pieces is not None

    def _process(self, pieces: Pieces | None) -> Iterator[LivePoints]:
        if pieces is None:
            yield from self._following.finish()
            return
        yield from self._following.push(pieces)
        with self._changed:
            self._waiting -= sum(piece.values.size for piece in pieces.values())


def start_stream(
    setup: Setup,
    channels: Mapping[Any, Declared],
    pipeline: str = AUTO,
    settings: Mapping[str, Any] | None = None,
    late_s: float = LATE_S,
    provisional: bool = True,
) -> LiveStream:
    """Return a stream for a vehicle with this ``setup``.

    ``channels`` holds the clock of each channel by its name, such as "left.height": a rate in Hz
    whose first sample is at 0 s, a `UniformClock`, or None for samples that come with their times.
    ``auto`` takes the pipeline that bears most, of those that have their channels. A channel that
    is ``late_s`` behind another counts as missing for that time. Without ``provisional`` points,
    there are final ones alone.

    Raises InputError for channels, a pipeline or settings that cannot be used.
    """
    clocks = read_declarations(channels)
    order = settle(setup, clocks, pipeline, settings, late_s)
    warm(order, provisional)
    return LiveStream(Following(order, provisional), Entrance(clocks))


def resume_stream(path: Path | str) -> LiveStream:
    """Return the stream that was saved in ``path``; push to it what that one was not given.

    Provisional points begin anew, and are not valid before the vehicle has gone a wavelength.
    Raises InputError for a file that is no saved stream, or of another version of floatref.
    """
    following, entrance = load_state(Path(path))
    warm(following.order, following.forward is not None)
    return LiveStream(following, entrance)
