"""Messages and answers as Arrow IPC streams: the same content as JSON lines, in two schemas.

A row of `MESSAGES` is a piece of samples of one channel, or, with the kind "finish", the end of the
run; the rows of a batch are one message. The hello is a JSON text in the metadata of the schema,
under the key `floatref-live`. A row of `answers_schema` is one wheel path of points; the other
answers are JSON texts in `message`.
"""

import io
import json
from collections.abc import Iterator
from io import BufferedReader
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.errors import InputError, missing_extra
from floatref.files.document import parse_document
from floatref.files.sources import name_errors
from floatref.live.points import LivePoints
from floatref.live.session.answers import Answer
from floatref.live.session.messages import (
    FORMAT,
    MOST_FIRST,
    Finish,
    Message,
    Piece,
    Samples,
    Sent,
    read_hello,
)
from floatref.values.arrays import FloatArray
from floatref.values.profile import ProfileTrack

if TYPE_CHECKING:
    import pyarrow

HELLO = b"floatref-live"
"""Key of the hello in the metadata of the schema."""
LARGEST_BYTES = 64 << 20
"""Largest part of a stream in bytes that is read at once; more is no message, or a wrong length."""
MESSAGES = {"kind": "str", "channel": "str", "first": "i8", "values": "f8s", "times_s": "f8s"}
"""Columns of messages; all but kind may be null."""
ANSWERS = {
    "kind": "str",
    "message": "str",
    "state": "str",
    "first": "i8",
    "interval_m": "f8",
    "pipeline": "str",
    "track": "str",
    "elevation": "f8s",
    "valid": "bools",
    "sigma": "f8s",
}
"""Columns of answers; all but kind may be null."""


def load_pyarrow() -> Any:
    """Return pyarrow; InputError that says how to install it."""
    try:
        import pyarrow
    except ImportError as error:
        raise missing_extra("messages in Arrow IPC need pyarrow", "adapters") from error
    return pyarrow


def schema_of(columns: dict[str, str], metadata: dict[bytes, bytes]) -> "pyarrow.Schema":
    """Return the Arrow schema of `MESSAGES` or `ANSWERS`."""
    pa = load_pyarrow()
    types = {
        "str": pa.string(),
        "i8": pa.int64(),
        "f8": pa.float64(),
        "f8s": pa.list_(pa.float64()),
        "bools": pa.list_(pa.bool_()),
    }
    fields = [pa.field(name, types[kind], name != "kind") for name, kind in columns.items()]
    return pa.schema(fields, metadata)


class Limited(io.RawIOBase):
    """Reads a stream, and refuses to read too much at once.

    Attributes:
        ended: whether there was less to read than was asked for.
    """

    def __init__(self, stream: BufferedReader) -> None:
        """Read ``stream``."""
        self._stream = stream
        self.ended = False

    def readable(self) -> bool:
        """Return that it can be read."""
        return True

    def read(self, size: int = -1) -> bytes:
        """Return ``size`` bytes, or fewer at the end; InputError for more than `LARGEST_BYTES`."""
        if not 0 <= size <= LARGEST_BYTES:
            raise InputError(
                f"a part of {size} bytes; send at most {LARGEST_BYTES >> 20} MiB in each batch"
            )
        data = self._stream.read(size)
        self.ended = len(data) < size
        return data


def read_arrow(stream: BufferedReader) -> Iterator[Sent]:
    """Yield the messages of an Arrow IPC ``stream``; a last batch that is cut is left out.

    Raises InputError naming schema or batch, row and field for what is no message.
    """
    pa = load_pyarrow()
    where, limited = "schema", Limited(stream)
    try:
        reader = pa.ipc.open_stream(limited)
        yield Sent(where, _read_hello(reader.schema))
        for number, batch in enumerate(reader, 1):
            where = f"batch {number}"
            with name_errors(where):
                yield from (Sent(where, each) for each in _read_batch(batch))
    except (pa.ArrowException, OSError, UnicodeDecodeError) as error:
        if limited.ended:
            return
        # pyarrow has an OSError for damaged bytes, too: only that of a system has a number.
        if isinstance(error, OSError) and error.errno is not None:
            raise
        raise InputError(f"behind {where}: no Arrow IPC ({error}); send a stream") from error


def _read_hello(schema: "pyarrow.Schema") -> Message:
    expected = schema_of(MESSAGES, {})
    names = schema.names
    for field in expected:
        found: object = "missing" if field.name not in names else "given twice"
        if names.count(field.name) == 1:
            found = schema.field(field.name).type
        if found != field.type:
            raise InputError(f"schema: column {field.name} is {found}; expected {field.type}")
    text = (schema.metadata or {}).get(HELLO)
    if text is None:
        raise InputError(f"schema: no metadata {HELLO.decode()}; put the hello there, as JSON")
    with name_errors("schema"):
        document = parse_document(text.decode("utf-8", "replace"))
    return read_hello(document, "schema")


def _read_batch(batch: "pyarrow.RecordBatch") -> Iterator[Message]:
    # Offsets that lead out of a buffer otherwise end the process, or show its memory.
    batch.validate(full=True)
    pieces: dict[str, Piece] = {}
    columns = {name: batch.column(name) for name in MESSAGES}
    ended = False
    for row in range(batch.num_rows):
        kind = columns["kind"][row].as_py()
        if kind not in ("samples", "finish"):
            raise InputError(f"row {row}: kind is {kind!r}; expected samples or finish")
        ended = ended or kind == "finish"
        if kind == "samples":
            name, piece = _read_row(columns, row)
            if name in pieces:
                raise InputError(f"row {row}: channel {name} is given twice; use another batch")
            pieces[name] = piece
    if pieces:
        yield Samples(pieces)
    if ended:
        yield Finish()


def _read_row(columns: dict[str, Any], row: int) -> tuple[str, Piece]:
    name, first = (columns[key][row].as_py() for key in ("channel", "first"))
    values, times = (_array(columns[key][row]) for key in ("values", "times_s"))
    if name is None or values is None:
        raise InputError(f"row {row}: has no {'channel' if name is None else 'values'}; give both")
    if first is not None and not 0 <= first <= MOST_FIRST:
        raise InputError(f"row {row}: first is {first}; expected the number of a sample, from 0 on")
    return name, Piece(values, times, first)


def _array(cell: Any) -> FloatArray | None:
    """Return the list in ``cell`` with NaN for null; None for no list."""
    if not cell.is_valid:
        return None
    return np.array(cell.values.to_numpy(zero_copy_only=False), dtype=np.float64)


class ArrowAnswers:
    """Encodes answers."""

    def __init__(self) -> None:
        """Begin the stream."""
        self._pa = load_pyarrow()
        self._schema = schema_of(ANSWERS, {HELLO: json.dumps({"format": FORMAT}).encode()})
        self._sink = io.BytesIO()
        self._writer = self._pa.ipc.new_stream(self._sink, self._schema)

    def encode(self, answer: Answer) -> bytes:
        """Return ``answer`` as one batch."""
        if answer.points is None:
            body = {"kind": answer.kind, **answer.body}
            rows = [{"kind": answer.kind, "message": json.dumps(body, allow_nan=False)}]
        else:
            rows = [_describe(answer.points, track) for track in answer.points.tracks]
        self._writer.write_batch(self._pa.RecordBatch.from_pylist(rows, self._schema))
        return self._take()

    def end(self) -> bytes:
        """Return the end of the stream."""
        self._writer.close()
        return self._take()

    def _take(self) -> bytes:
        data = self._sink.getvalue()
        self._sink.seek(0)
        self._sink.truncate()
        return data


def _describe(points: LivePoints, track: ProfileTrack) -> dict[str, Any]:
    return {
        "kind": "points",
        "state": str(points.state),
        "first": points.first,
        "interval_m": points.interval_m,
        "pipeline": points.pipeline,
        "track": track.name,
        "elevation": track.elevation,
        "valid": track.valid,
        "sigma": track.sigma,
    }
