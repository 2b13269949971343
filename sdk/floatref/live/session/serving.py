"""Serves a run to one peer: its messages in, the answers out, until the run or the peer ends."""

import hmac
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from io import BufferedReader

from floatref.errors import FloatrefError, InputError
from floatref.files.sources import name_errors
from floatref.live.session.answers import Answer, refused
from floatref.live.session.encodings import Encoder, Reading
from floatref.live.session.live_run import LiveRun
from floatref.live.session.mailboxes import Inbox, Outbox
from floatref.live.session.messages import Finish, Hello, Sent

POLL_S = 0.1
"""Time in s between two looks for points that are ready."""
HELLO_S = 30.0
"""Time in s within which the hello of a peer that connects has to come."""
ENDING_S = 1.0
"""Time in s that a peer has to read the answers after Ctrl-C; points are on the disk."""
RESUME = "; what has come is saved, go on with --resume"


class PeerLost(InputError):
    """The peer is gone and has not sent the message finish; the run is saved."""


class NotLetIn(InputError):
    """A hello without the right token."""


@dataclass(frozen=True)
class Peer:
    """Another program.

    Attributes:
        stream: what it sends.
        write: writes bytes to it; OSError once it is gone.
        name: of it, for a line.
        token: what its hello has to hold; empty if it needs no token.
        from_start: whether it sends all samples from the start, as a file does.
        is_remote: whether anyone could be there, so that its hello has to come soon.
    """

    stream: BufferedReader
    write: Callable[[bytes], object]
    name: str
    token: str = ""
    from_start: bool = False
    is_remote: bool = False


class Serving:
    """Serves ``run`` to ``peer``.

    Attributes:
        greeted: whether the peer was let in.
        is_lost: whether it has gone before the end of the run.
    """

    def __init__(self, run: LiveRun, peer: Peer) -> None:
        """Begin to read what the peer sends."""
        self._run, self._peer = run, peer
        self._reading = Reading(peer.stream)
        self._inbox = Inbox(self._reading.messages())
        self._outbox = Outbox(peer.write)
        self._encoder: Encoder | None = None
        self._until_s = time.monotonic() + HELLO_S
        self.greeted = self.is_lost = False

    def serve(self) -> None:
        """Return once the run is complete.

        Raises InputError, after it has answered it, for a message that cannot be used; PeerLost if
        the peer is gone; NotLetIn for a wrong token. All that has come is saved before.
        """
        try:
            while not self._step():
                pass
        except InputError as error:
            self._save()
            self.is_lost = isinstance(error, PeerLost)
            if not self.is_lost:
                self._answer([refused(error)])
            self._end(str(error), None if self.greeted else HELLO_S)
            raise
        except BaseException as error:
            try:
                self._save()
            finally:
                self._end(str(error), ENDING_S)
            raise
        self._end("complete", None)

    def _end(self, text: str, limit_s: float | None) -> None:
        """Wait until the peer has read the answers or is gone; for ``limit_s`` at most."""
        self._run.watch.ended(text)
        self._inbox.close()
        self._outbox.end(b"" if self._encoder is None else self._encoder.end())
        self._outbox.drain(limit_s)

    def _step(self) -> bool:
        """Take one message, if there is one; return whether the run is complete."""
        if self._outbox.lost:
            raise self._lost("reads no answers any more")
        sent = self._next()
        if sent is not None and self._obey(sent):
            return True
        if self.greeted:
            self._answer(self._run.poll())
        return False

    def _next(self) -> Sent | None:
        if self._peer.is_remote and not self.greeted and time.monotonic() > self._until_s:
            raise NotLetIn(f"no hello within {HELLO_S:g} s; send one first")
        try:
            return self._inbox.get(POLL_S)
        except EOFError:
            raise self._lost("ended without the message finish") from None
        except OSError as error:
            raise self._lost(error.strerror or str(error)) from error

    def _lost(self, reason: str) -> PeerLost:
        remedy = RESUME if self._run.is_begun else "; no hello has come, begin again"
        return PeerLost(f"{self._peer.name}: {reason}{remedy}")

    def _obey(self, sent: Sent) -> bool:
        where, message = sent
        if isinstance(message, Hello):
            return self._greet(where, message)
        if not self.greeted:
            raise InputError(f"{where}: the first message has to be a hello; send one")
        if isinstance(message, Finish):
            self._answer(self._run.finish())
            return True
        with name_errors(where):
            self._answer(self._run.take(message))
        return False

    def _greet(self, where: str, hello: Hello) -> bool:
        if self.greeted:
            raise InputError(f"{where}: a second hello; send one, and then samples")
        given, asked = hello.token.encode(), self._peer.token.encode()
        if asked and not hmac.compare_digest(given, asked):
            raise NotLetIn(f"{where}: token is not that of this server; send the one of its file")
        if self._run.complete:
            self._answer(self._run.completed(hello.points_from))
            return True
        with name_errors(where):
            self._answer(self._run.greet(hello, self._peer.from_start))
        self.greeted = True
        return False

    def _save(self) -> None:
        """Save what has come; a stream that has failed keeps what was saved before."""
        with suppress(FloatrefError):
            self._answer(self._run.save())

    def _answer(self, answers: Iterable[Answer]) -> None:
        for answer in answers:
            if self._encoder is None:
                self._encoder = self._reading.encoder()
            self._outbox.put(self._encoder.encode(answer))
