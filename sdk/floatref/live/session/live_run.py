"""One run from its hello to its end, whatever brings the messages and takes the answers."""

import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.profile_directory import read_profile
from floatref.live.points import LivePoints, State
from floatref.live.session import answers
from floatref.live.session.answers import Answer
from floatref.live.session.messages import Hello, Piece, Samples, read_hello
from floatref.live.session.point_parts import cut_tracks, parts
from floatref.live.session.run_directory import RunDirectory, is_complete
from floatref.live.session.run_lock import RunLock
from floatref.live.session.sample_numbers import SampleNumbers, describe_missing, fill
from floatref.live.session.watch import Odometer, Watch
from floatref.live.stream import LiveStream, start_stream
from floatref.stages.signals import DISTANCE

SAVE_S = 10.0
"""Time in s after which the samples that have come are saved, though no point is final."""


class LiveRun:
    """Serves one run into one directory; peers may come and go.

    Attributes:
        complete: whether the profile is complete.
        watch: who looks on.
    """

    def __init__(
        self,
        path: Path,
        resume: bool,
        save_s: float = SAVE_S,
        watch: Watch | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Serve the run that is to be made at ``path``, or ``resume`` the one there.

        Raises InputError for a directory without a run to resume, and one that is served.
        """
        self._path, self._save_s, self._clock = path, save_s, clock
        self.watch = watch or Watch()
        self._directory: RunDirectory | None = None
        self._stream: LiveStream | None = None
        self._numbers = SampleNumbers({}, {})
        self._distance, self._odometer = DISTANCE, Odometer(None)
        self._saved_at = clock()
        self._unsaved = self._torn = False
        self._lock = RunLock(path) if resume else None
        self.complete = False
        if resume:
            self._reopen()

    @property
    def is_begun(self) -> bool:
        """Whether there is a directory to go on from."""
        return self._directory is not None

    @property
    def is_saved(self) -> bool:
        """Whether all that has come is on the disk."""
        return self.complete or not (self._unsaved or self._torn)

    def greet(self, hello: Hello, from_start: bool = False) -> Iterator[Answer]:
        """Begin the run, or go on with it, and yield the answers.

        A peer that sends all samples ``from_start`` need not number them. Raises InputError for a
        hello that is not that of the run.
        """
        if self._directory is None:
            self._begin(hello)
        else:
            self._check_same(hello)
        assert self._stream is not None
        self._numbers.begin(from_start)
        self.watch.started(self._stream)
        yield answers.started(
            self._stream, self._stream.interval_m, self._stream.tracks, self._state()
        )
        if hello.points_from is not None:
            yield from self._read_again(hello.points_from)

    def take(self, samples: Samples) -> Iterator[Answer]:
        """Push ``samples`` and yield what there is to answer; InputError for unusable samples."""
        numbered = self._numbers.number(samples)
        for name, each in numbered.items():
            if each.missing:
                text = describe_missing(name, each.missing, self._numbers)
                self.watch.missed(name, each.missing)
                self.watch.event(text)
                yield answers.event(text)
        for pieces in fill(numbered, self._numbers.clocks):
            self._push(pieces)
        self._numbers.skip(numbered)
        self._push({name: each.piece for name, each in numbered.items()})
        self._observe(samples)

    def poll(self) -> Iterator[Answer]:
        """Yield the answers that have become ready; final points are on the disk before that."""
        if self._stream is None:
            return
        points = self._stream.peek()
        due = self._unsaved and self._clock() - self._saved_at >= self._save_s
        if due or any(each.state is State.FINAL for each in points):
            yield from self._save()
        else:
            self._stream.forget(points)
            yield from self._give(points)

    def save(self) -> Iterator[Answer]:
        """Save all that has come, and yield the answers that are ready.

        A stream that has failed within a push has more samples than were counted: of such a run
        what was saved before remains.
        """
        if self._stream is None or self._directory is None or self._torn:
            return
        if self._stream.is_open:
            yield from self._save()

    def finish(self) -> Iterator[Answer]:
        """Complete the profile, and yield the last answers.

        All is saved before, so that a run that is ended meanwhile goes on from there. Raises
        InputError where no point is final, or the pipeline has refused every window.
        """
        assert self._stream is not None
        assert self._directory is not None
        yield from self._save()
        self.watch.waited(True)
        points = self._stream.finish()
        self.watch.waited(False)
        self._directory.finish([each for each in points if each.state is State.FINAL])
        self.complete = True
        yield from self._give(points)
        yield from self.completed()

    def completed(self, points_from: int | None = None) -> Iterator[Answer]:
        """Yield the points from a number on, if there is one, and that the profile is complete."""
        profile = read_profile(self._path)
        count, begin = profile.tracks[0].elevation.size, round(profile.start_m / profile.interval_m)
        for low, high in parts(points_from, begin, begin + count):
            tracks = cut_tracks(profile, low - begin, high - begin)
            made = profile.interval_m, tracks, State.FINAL, profile.pipeline
            yield from answers.of_points(LivePoints(low, *made))
        self.watch.completed()
        yield answers.finished(self._path, count, profile.interval_m)

    def close(self) -> None:
        """End the thread of the stream; what is not saved is lost. Others may then resume it."""
        if self._stream is not None:
            self._stream.close()
        if self._lock is not None:
            self._lock.release()

    def _begin(self, hello: Hello) -> None:
        if not hello.channels:
            raise InputError("hello: has no channels; name each with its unit and rate_hz")
        given = hello.pipeline, hello.settings, hello.late_s, hello.provisional
        self._stream = start_stream(hello.setup, hello.channels, *given)
        self._know(hello, {str(name): 0 for name in hello.channels})
        self._directory = RunDirectory.begin(
            self._path, hello.document, self._stream, self._numbers.next
        )
        self._lock = RunLock(self._path)

    def _reopen(self) -> None:
        try:
            self.complete = is_complete(self._path)
            if not self.complete:
                self._directory, self._stream, sent = RunDirectory.reopen(self._path)
                self._know(read_hello(self._directory.hello, f"{self._path}: hello"), sent)
        except BaseException:
            self.close()
            raise

    def _know(self, hello: Hello, sent: Mapping[str, int]) -> None:
        clocks = {str(name): clock for name, clock in hello.channels.items()}
        self._numbers = SampleNumbers(clocks, sent)
        self._distance = next((n for n in clocks if n.rpartition(".")[2] == DISTANCE), DISTANCE)
        self._odometer = Odometer(clocks.get(self._distance))
        self.watch.declared(clocks)

    def _check_same(self, hello: Hello) -> None:
        assert self._directory is not None
        for key, value in hello.document.items():
            if self._directory.hello.get(key) != value:
                raise InputError(
                    f"hello: {key} differs from that of the run in {self._path}; leave it out, or "
                    "begin another run"
                )

    def _push(self, pieces: Mapping[str, Piece]) -> None:
        assert self._stream is not None
        if self.take_whole(self._stream, pieces):
            self._stream.hand_over()

    def take_whole(self, stream: LiveStream, pieces: Mapping[str, Piece]) -> bool:
        """Let ``stream`` take ``pieces``, count them, and return whether its `hand_over` is due."""
        given: dict[Any, Any] = {name: p.pushed for name, p in pieces.items() if p.values.size}
        self._torn = True
        try:
            is_due = bool(given) and stream.take_whole(given)
        except InputError:
            # Then it has taken nothing.
            self._torn = False
            raise
        self._numbers.count(pieces)
        self._unsaved, self._torn = self._unsaved or bool(given), False
        return is_due

    def _observe(self, samples: Samples) -> None:
        counts = {name: each.values.size for name, each in samples.channels.items()}
        piece = samples.channels.get(self._distance)
        if piece is not None:
            self._odometer.add(piece, self._numbers.come[self._distance] - piece.values.size)
        self.watch.read(samples.channels)
        self.watch.took(self._odometer.see(counts))

    def _save(self) -> Iterator[Answer]:
        """Save all that has come; the stream has its points until they are stored."""
        assert self._stream is not None
        assert self._directory is not None
        self.watch.waited(True)
        points = self._stream.peek(wait=True)
        self.watch.waited(False)
        final = [each for each in points if each.state is State.FINAL]
        self._directory.store(final, self._stream, self._numbers.next)
        self._stream.forget(points)
        self._saved_at, self._unsaved = self._clock(), False
        yield from self._give(points)
        yield answers.saved(self._state())

    def _give(self, points: list[LivePoints]) -> Iterator[Answer]:
        for each in points:
            self.watch.gave(each)
            yield from answers.of_points(each)

    def _state(self) -> dict[str, Any]:
        assert self._directory is not None
        return {"next": dict(self._numbers.next), "points": self._directory.profile.count}

    def _read_again(self, first: int) -> Iterator[Answer]:
        assert self._directory is not None
        profile = self._directory.profile
        if profile.first is None or profile.end is None:
            return
        for low, high in parts(first, profile.first, profile.end):
            tracks = profile.read(low, high)
            points = LivePoints(low, profile.interval_m, tuple(tracks), State.FINAL)
            yield from answers.of_points(points)
