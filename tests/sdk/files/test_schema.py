"""The schemas are valid, agree with the channels, and their errors say what to do."""

from dataclasses import fields

import pytest
from jsonschema import Draft202012Validator

from floatref.errors import InputError
from floatref.files import read_schema
from floatref.files.schema import SCHEMAS, enforce
from floatref.mapping.channel_map.entries import ChannelEntry, ClockEntry
from floatref.values.channels import CHANNELS
from floatref.values.recording import Setup


@pytest.mark.parametrize("name", SCHEMAS)
def test_the_schema_is_valid_draft_2020_12(name: str) -> None:
    schema = read_schema(name)
    Draft202012Validator.check_schema(schema)
    assert schema["$schema"] == Draft202012Validator.META_SCHEMA["$id"]


def test_the_recording_schema_knows_exactly_the_channels() -> None:
    channel = read_schema("floatref-recording-1")["$defs"]["channel"]
    assert channel["properties"]["name"]["enum"] == list(CHANNELS)


def test_the_limits_of_the_interval_are_those_of_the_setup() -> None:
    entry = read_schema("floatref-recording-1")["properties"]["setup"]["properties"]
    limits = entry["profile_interval_m"]
    for interval in (limits["minimum"], limits["maximum"]):
        assert Setup(interval).profile_interval_m == interval
    for interval in (limits["minimum"] / 1.01, limits["maximum"] * 1.01):
        with pytest.raises(InputError, match="give the profile interval in m"):
            Setup(interval)


def test_the_schema_may_be_changed_by_its_reader_without_effect() -> None:
    read_schema("floatref-profile-1")["properties"].clear()
    with pytest.raises(InputError, match="format is 5"):
        enforce({"format": 5}, "floatref-profile-1", "x")


def test_an_unknown_schema_is_refused() -> None:
    with pytest.raises(InputError, match="schema nope: unknown; known: floatref-recording-1"):
        read_schema("nope")


@pytest.mark.parametrize("document", [None, [], "text", 3, True])
@pytest.mark.parametrize("name", SCHEMAS)
def test_a_document_that_is_no_object_is_refused(name: str, document: object) -> None:
    with pytest.raises(InputError, match=r"^x: is .*; expected a.* with format"):
        enforce(document, name, "x")


def keys_of(kind: type) -> set[str]:
    return {field.name for field in fields(kind)}


def test_the_map_schema_knows_exactly_what_an_entry_of_a_channel_or_a_clock_holds() -> None:
    known = read_schema("floatref-map-1")["properties"]
    assert set(known["channels"]["items"]["properties"]) == keys_of(ChannelEntry) | {"axis"}
    clock = set(known["clocks"]["items"]["properties"])
    assert clock == keys_of(ClockEntry) - {"rate"} | {"rate_hz"}


def test_maps_and_recordings_have_the_same_setup() -> None:
    maps, recordings = (read_schema(f"floatref-{kind}-1") for kind in ("map", "recording"))
    for name in ("offset", "track"):
        assert maps["$defs"][name] == recordings["$defs"][name]
    ours, theirs = (s["properties"]["setup"]["properties"] for s in (maps, recordings))
    assert ours.keys() == theirs.keys()
    for end in ("minimum", "maximum"):
        assert ours["profile_interval_m"][end] == theirs["profile_interval_m"][end]


def objects(schema: object) -> list[dict]:
    if isinstance(schema, list):
        return [found for item in schema for found in objects(item)]
    if not isinstance(schema, dict):
        return []
    here = [schema] if schema.get("type") == "object" else []
    return here + [found for item in schema.values() for found in objects(item)]


def test_no_table_of_a_map_takes_a_key_that_nobody_reads() -> None:
    found = objects(read_schema("floatref-map-1"))
    assert len(found) >= 8
    for table in found:
        assert table.get("additionalProperties") is False or isinstance(
            table["additionalProperties"], dict
        )
        assert table["description"]


CHANNEL = {"native": "a", "channel": "height"}


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({}, "has no channels"),
        ({"channels": []}, "channels is a list of 0; expected a list of 1 to 256 channels"),
        ({"channels": [CHANNEL] * 257}, "channels is a list of 257"),
        ({"channels": [{"native": "a"}]}, r"channels\[0\] has no channel; expected a channel with"),
        ({"channels": [{**CHANNEL, "unt": "m"}]}, 'unknown key "unt"; did you mean unit\\?'),
        ({"channels": [{**CHANNEL, "xyz": 1}]}, 'unknown key "xyz"; known: native, channel, '),
        ({"channels": [{**CHANNEL, "axis": "+Z"}]}, r'axis \(height\)? ?is "\+Z"; (did|known)'),
        (
            {"channels": [{**CHANNEL, "scale": True}]},
            r"\.scale \(height\) is true; expected a number other",
        ),
        ({"channels": [{**CHANNEL, "sign": 0}]}, r"\.sign \(height\) is 0; expected 1 or -1"),
        (
            {"channels": [{**CHANNEL, "wrap": 0}]},
            r"\.wrap \(height\) is 0; expected the number of counts",
        ),
        ({"channels": [{**CHANNEL, "track": "a/b"}]}, 'is "a/b"; expected the name of a wheel'),
        ({"channels": [CHANNEL], "clocks": [{"rate_hz": 0}]}, "is 0; expected a rate in Hz"),
        ({"channels": [CHANNEL], "clocks": [{"rate_hz": "1/2/3"}]}, "expected a rate in Hz"),
        ({"channels": [CHANNEL], "files": [{"name": "a\n", "path": "b"}]}, "printable characters"),
        ({"channels": [CHANNEL], "setup": {"tracks": {"a/b": {}}}}, 'holds the name "a/b"'),
    ],
)
def test_a_map_that_breaks_the_schema_is_told_where_and_how(more: dict, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        enforce({"format": "floatref-map/1", **more}, "floatref-map-1", "map.toml")
    assert str(caught.value).startswith("map.toml: ")


def test_the_shortest_map_is_one_channel() -> None:
    enforce({"format": "floatref-map/1", "channels": [CHANNEL]}, "floatref-map-1", "map.toml")
