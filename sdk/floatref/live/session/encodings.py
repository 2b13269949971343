"""JSON lines or Arrow: the first byte of a peer shows which, and it is answered likewise."""

from collections.abc import Iterator
from io import BufferedReader
from typing import Protocol

from floatref.live.session.answers import Answer
from floatref.live.session.json_lines import JsonLines, read_json_lines
from floatref.live.session.messages import Sent

ARROW = 0xFF
"""First byte of an Arrow stream, of its continuation marker; no UTF-8 text begins with it."""


class Encoder(Protocol):
    """Encodes answers, in order."""

    def encode(self, answer: Answer) -> bytes:
        """Return ``answer`` as bytes."""

    def end(self) -> bytes:
        """Return what follows the last answer."""


class Reading:
    """Reads what a peer sends."""

    def __init__(self, stream: BufferedReader) -> None:
        """Read ``stream``."""
        self._stream = stream
        self._is_arrow = False

    def messages(self) -> Iterator[Sent]:
        """Yield the messages; InputError naming the place of what is no message."""
        self._is_arrow = self._stream.peek(1)[:1] == bytes([ARROW])
        if not self._is_arrow:
            yield from read_json_lines(self._stream)
            return
        from floatref.live.session.arrow_stream import read_arrow

        yield from read_arrow(self._stream)

    def encoder(self) -> Encoder:
        """Return what encodes answers as the first message was."""
        if not self._is_arrow:
            return JsonLines()
        from floatref.live.session.arrow_stream import ArrowAnswers

        return ArrowAnswers()
