"""Samples are checked by hand, for speed: the code takes what the schema takes, and no more."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from floatref import InputError
from floatref.files.schema import read_schema
from floatref.live.session.messages import (
    FORMAT,
    Finish,
    Hello,
    Samples,
    read_hello,
    read_message,
)

SCHEMA = Draft202012Validator(read_schema("floatref-live-1"))
ODD = st.sampled_from([None, True, "x", "1.0", 1.5, -1, 3, 3.0, 10**16, [], {}, [1.0]])
VALUES = st.lists(
    st.one_of(st.floats(-1e300, 1e300), st.integers(-5, 5), st.none(), ODD), max_size=4
)
PIECES = st.fixed_dictionaries(
    {},
    optional={
        "first": st.one_of(st.integers(0, 9), ODD),
        "values": st.one_of(VALUES, st.lists(st.floats(-1.0, 1.0)), ODD),
        "times_s": st.one_of(st.lists(st.floats(0.0, 1.0)), ODD),
        "more": ODD,
    },
)
DOCUMENTS = st.fixed_dictionaries(
    {"kind": st.just("samples")},
    optional={
        "channels": st.one_of(
            st.dictionaries(st.sampled_from(["left.height", "x"]), st.one_of(PIECES, ODD)), ODD
        ),
        "more": ODD,
    },
)
HEIGHT = {"name": "height", "track": "left", "unit": "m", "rate_hz": 100.0}
HELLO = {"kind": "hello", "format": FORMAT, "channels": [HEIGHT]}


@settings(max_examples=60)
@given(DOCUMENTS)
def test_the_code_takes_the_samples_that_the_schema_takes(document):
    if not SCHEMA.is_valid(document):
        with pytest.raises(InputError, match=r"^line 1: channels"):
            read_message(document, "line 1")
        return
    message = read_message(document, "line 1")
    assert isinstance(message, Samples)
    for name, piece in message.channels.items():
        expected = [np.nan if v is None else v for v in document["channels"][name]["values"]]
        np.testing.assert_array_equal(piece.values, np.array(expected, dtype=float))


@given(st.sampled_from(["hello", "finish", "started", "", None, 3]), st.booleans())
def test_other_kinds_are_those_of_the_schema(kind, whole):
    document = {**(HELLO if whole else {}), "kind": kind}
    if SCHEMA.is_valid(document):
        assert isinstance(read_message(document, "line 1"), Hello | Finish)
        return
    with pytest.raises(InputError, match=r"^line 1: "):
        read_message(document, "line 1")


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"format": "floatref-live/2"}, r"format is .floatref-live/2.; expected .floatref-live/1."),
        ({"channels": [{**HEIGHT, "unit": "mm"}]}, r"channels\[0\]: channel left\.height: "),
        ({"channels": [HEIGHT, HEIGHT]}, r"channels\[1\]: channel left\.height: given twice"),
        (
            {"channels": [{**HEIGHT, "name": "hight"}]},
            r"channels\[0\]\.name .* is .hight.; did you mean height",
        ),
        ({"channels": [{**HEIGHT, "rate_hz": 0}]}, r"channels\[0\]\.rate_hz .* is 0; expected the"),
        ({"setup": {"profile_interval_m": "0.1"}}, r"setup\.profile_interval_m is .0\.1."),
        ({"late_s": 0}, "late_s is 0; expected how much later"),
    ],
)
def test_a_hello_that_cannot_be_used_names_the_field(changes, line):
    with pytest.raises(InputError, match=f"^line 1: {line}"):
        read_hello({**HELLO, **changes}, "line 1")


def test_the_token_is_not_stored():
    hello = read_hello({**HELLO, "token": "secret", "points_from": 4}, "line 1")
    assert hello.token == "secret"
    assert hello.points_from == 4
    assert hello.document == HELLO


def test_setup_and_channels_are_those_of_a_recording():
    recording, live = (read_schema(f"floatref-{name}-1") for name in ("recording", "live"))
    hello = live["$defs"]["hello"]["properties"]
    assert hello["setup"] == recording["properties"]["setup"]
    known = recording["$defs"]["channel"]["properties"]
    for key, value in hello["channels"]["items"]["properties"].items():
        assert value == known[key]
    for shared in ("track", "offset"):
        assert live["$defs"][shared] == recording["$defs"][shared]


def test_the_page_has_every_key(page):
    for name in ("floatref-live-1", "floatref-live-answer-1"):
        for kind, definition in read_schema(name)["$defs"].items():
            for key in definition.get("properties", {}):
                assert f"`{key}`" in page, (kind, key)


def test_the_examples_of_the_page_obey_the_schemas(page):
    answers = Draft202012Validator(read_schema("floatref-live-answer-1"))
    seen = set()
    for block in page.split("```json\n")[1:]:
        for line in block.partition("```")[0].splitlines():
            document = json.loads(line)
            (SCHEMA if SCHEMA.is_valid(document) else answers).validate(document)
            seen.add(document["kind"])
    assert seen == {"hello", "samples", "finish", "started", "points", "event"} | {
        "saved",
        "refused",
        "finished",
    }
