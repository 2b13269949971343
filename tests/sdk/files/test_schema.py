"""The schemas are valid, agree with the channels, and their errors say what to do."""

import pytest
from jsonschema import Draft202012Validator

from floatref.errors import InputError
from floatref.files import read_schema
from floatref.files.schema import SCHEMAS, enforce
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
    with pytest.raises(InputError, match=r"^x\.json: is .*; expected an object with format"):
        enforce(document, name, "x.json")
