"""Arrow carries what JSON lines carry: the same points come back, bit for bit."""

import io
import json

import numpy as np
import pyarrow as pa
import pytest

from floatref.errors import InputError
from floatref.files.schema import enforce
from floatref.live.session.arrow_stream import ANSWERS, MESSAGES, schema_of

LEGS = [(20.0, 150.0)]


def as_arrow(messages):
    """Return the same messages as one Arrow stream."""
    hello, *rest = messages
    schema = schema_of(MESSAGES, {b"floatref-live": json.dumps(hello).encode()})
    sink = io.BytesIO()
    with pa.ipc.new_stream(sink, schema) as writer:
        for message in rest:
            rows = [
                {"kind": "samples", "channel": name, **piece}
                for name, piece in message.get("channels", {}).items()
            ]
            rows = rows or [{"kind": "finish"}]
            writer.write_batch(pa.RecordBatch.from_pylist(rows, schema))
    return sink.getvalue()


def answers_in(data):
    """Return the answers of an Arrow stream as those of JSON lines are."""
    found = []
    for row in pa.ipc.open_stream(data).read_all().to_pylist():
        if row["message"] is not None:
            found.append(json.loads(row["message"]))
            continue
        track = {"elevation": nulls(row["elevation"]), "valid": row["valid"]}
        if row["sigma"] is not None:
            track["sigma"] = nulls(row["sigma"])
        keys = ("kind", "state", "first", "interval_m", "pipeline")
        found.append({k: row[k] for k in keys} | {"tracks": {row["track"]: track}})
    return found


def nulls(values):
    return [None if v is None or np.isnan(v) else v for v in values]


@pytest.fixture(scope="module")
def messages(drive, live):
    return live.messages_of(drive(LEGS, distance="times"), step_s=5.0)


@pytest.mark.slow
def test_the_answers_are_those_to_json_lines(messages, live, tmp_path):
    data, error = live.serve_bytes(tmp_path / "arrow", as_arrow(messages))
    assert error is None
    expected, _ = live.serve(tmp_path / "json", messages)
    found = answers_in(data)
    for answer in (found[-1], expected[-1]):
        answer.pop("profile")
    # When the stream is saved depends on the clock.
    found, expected = ([a for a in some if a["kind"] != "saved"] for some in (found, expected))
    assert found == expected
    for answer in found[:1]:
        enforce(answer, "floatref-live-answer-1", "answer")


@pytest.mark.parametrize("cut", [1, 8, 9, 500, 5000])
def test_a_stream_that_is_cut_is_a_peer_that_has_gone(messages, live, tmp_path, cut):
    data = as_arrow(messages[:-1])
    found, error = live.serve_bytes(tmp_path / "run", data[: len(data) - cut])
    assert "ended without the message finish" in str(error)
    answers = answers_in(found)
    assert answers[0]["kind"] == "started"
    assert answers[-1]["next"]["left.height"] > 25_000


def break_metadata(messages):
    return as_arrow([{**messages[0], "late_s": -1}, *messages[1:]])


def break_row(messages):
    odd = {"kind": "samples", "channels": {"left.speed": {"values": [1.0]}}}
    return as_arrow([messages[0], odd])


def break_first(messages):
    odd = {"kind": "samples", "channels": {"left.height": {"values": [1.0], "first": -2}}}
    return as_arrow([messages[0], messages[1], odd])


def break_bytes(messages):
    data = bytearray(as_arrow(messages))
    at = len(data) // 2
    data[at : at + 2000] = bytes(range(250)) * 8
    return bytes(data)


def break_flatbuffer(messages):
    """Damage what pyarrow checks before the schema, and has an OSError for."""
    data = bytearray(as_arrow(messages))
    data[8:40] = b"\xff" * 32
    return bytes(data)


def break_offsets(messages):
    """Let the text of a cell end before it begins: pyarrow ends the process that reads it."""
    hello, *rest = messages
    data = bytearray(as_arrow([hello, {"channels": {"left.height": {"values": [1.0]}}}, *rest]))
    at = data.index(b"left.height", data.index(b"samples")) - 8
    assert data[at : at + 8] == bytes(4) + (11).to_bytes(4, "little")
    data[at + 7] = 0x80
    return bytes(data)


def break_name(messages):
    data = as_arrow(messages)
    return data.replace(b"values", b"\xe6alues")


def break_twice(messages):
    """Give two columns one name."""
    return as_arrow(messages).replace(b"times_s\0", b"channel\0")


def break_length(messages):
    return as_arrow(messages[:3])[:-8] + b"\xff\xff\xff\xff\xff\xff\xff\x7f" + bytes(100)


def break_columns(messages):
    schema = pa.schema([("kind", pa.string())])
    sink = io.BytesIO()
    with pa.ipc.new_stream(sink, schema):
        pass
    return sink.getvalue()


@pytest.mark.parametrize(
    ("broken", "line"),
    [
        (break_metadata, "schema: late_s is -1; expected how much later"),
        (break_row, "batch 1: channels.left.speed: was not declared in the hello"),
        (break_first, "batch 2: row 0: first is -2; expected the number of a sample"),
        (break_columns, "schema: column channel is missing; expected string"),
        (break_length, "a part of 2147483647 bytes; send at most 64 MiB"),
    ],
)
def test_what_is_no_message_is_named(messages, live, tmp_path, broken, line):
    _, error = live.serve_bytes(tmp_path / "run", broken(messages))
    assert isinstance(error, InputError)
    assert line in str(error)


DAMAGES = (break_bytes, break_flatbuffer, break_offsets, break_name, break_twice)


@pytest.mark.parametrize("broken", DAMAGES)
def test_damaged_bytes_end_in_one_line(messages, live, tmp_path, broken):
    _, error = live.serve_bytes(tmp_path / "run", broken(messages))
    assert isinstance(error, InputError)


def test_the_page_lists_the_columns(page):
    for columns in (MESSAGES, ANSWERS):
        for name in columns:
            assert f"| `{name}` |" in page
