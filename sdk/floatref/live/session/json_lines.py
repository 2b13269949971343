"""Messages and answers as JSON lines: one object in each, UTF-8."""

import json
from collections.abc import Iterator
from io import BufferedReader
from typing import Any

from floatref.errors import InputError
from floatref.files.document import parse_document
from floatref.files.sources import name_errors
from floatref.live.session.answers import Answer
from floatref.live.session.messages import LARGEST_BYTES, Sent, read_message
from floatref.values.arrays import FloatArray


def read_json_lines(stream: BufferedReader, most_bytes: int = LARGEST_BYTES) -> Iterator[Sent]:
    """Yield the messages of ``stream``; a last line without an end is left out.

    Raises InputError naming line and field for what is no message.
    """
    number = 0
    while line := stream.readline(most_bytes + 1):
        number += 1
        if len(line) > most_bytes:
            raise InputError(
                f"line {number}: longer than {most_bytes >> 20} MiB; send fewer samples in each"
            )
        if not line.endswith(b"\n"):
            return
        if line.strip():
            where = f"line {number}"
            yield Sent(where, read_message(_parse(line, where), where))


def _parse(line: bytes, where: str) -> Any:
    with name_errors(where):
        try:
            return parse_document(line.decode("utf-8-sig"))
        except UnicodeDecodeError as error:
            raise InputError(f"byte {error.start} is not UTF-8 text; send JSON in UTF-8") from error


class JsonLines:
    """Encodes answers."""

    def encode(self, answer: Answer) -> bytes:
        """Return ``answer`` as one line."""
        body = dict(answer.body)
        if answer.points is not None:
            body["tracks"] = {
                track.name: {
                    "elevation": _list(track.elevation),
                    "valid": track.valid.tolist(),
                    **({} if track.sigma is None else {"sigma": _list(track.sigma)}),
                }
                for track in answer.points.tracks
            }
        return json.dumps({"kind": answer.kind, **body}, allow_nan=False).encode() + b"\n"

    def end(self) -> bytes:
        """Return what follows the last answer: nothing."""
        return b""


def _list(values: FloatArray) -> list[float | None]:
    return [None if value != value else value for value in values.tolist()]
