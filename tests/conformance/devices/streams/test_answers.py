"""Answers of a stream: sound ones are read, and a wrong one is a fault that names its field."""

import json

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from floatref_conformance.devices.streams.answers import (
    kind_of,
    read_number,
    read_points,
    read_started,
)
from floatref_conformance.errors import DeviceError
from floatref_conformance.schemas import read_schema

SCHEMA = Draft202012Validator(read_schema("conformance-stream-answer-1"))
LATENCY = {"travelled_m": 10, "then_s": 0.5, "longest_s": 30, "provisional_s": None}
STARTED = {"kind": "started", "format": "floatref-live/1", "latency": LATENCY}
TRACK = {"elevation": [0.25, None], "valid": [True, False]}
POINTS = {
    "kind": "points",
    "state": "final",
    "first": -3,
    "interval_m": 0.1,
    "tracks": {"left": TRACK},
}
SYNCED = {"kind": "synced", "number": 4}


def changed(message, path, value):
    """Return ``message`` with ``value`` at ``path``; it is left out if that is ``...``."""
    copy = json.loads(json.dumps(message))
    at = copy
    for key in path[:-1]:
        at = at[key]
    if value is ...:
        del at[path[-1]]
    else:
        at[path[-1]] = value
    return copy


WRONG = [
    (STARTED, ("format",), "floatref-live/2", "format 'floatref-live/2'"),
    (STARTED, ("latency",), ..., "latency"),
    (STARTED, ("latency", "travelled_m"), ..., "travelled_m is None"),
    (STARTED, ("latency", "then_s"), -1, "then_s is -1"),
    (STARTED, ("latency", "longest_s"), True, "longest_s is True"),
    (POINTS, ("state",), "last", "state 'last'"),
    (POINTS, ("first",), 0.5, "first is 0.5"),
    (POINTS, ("interval_m",), 0, "interval_m 0"),
    (POINTS, ("interval_m",), 2.0, "interval_m 2"),
    (POINTS, ("tracks",), {}, "without tracks"),
    (POINTS, ("tracks", "left", "valid"), ..., "track left"),
    (POINTS, ("tracks", "left", "valid"), [True, 1], "track left"),
    (POINTS, ("tracks", "left", "elevation"), ["0.1", None], "no number"),
    (POINTS, ("tracks", "left"), {"elevation": [], "valid": []}, "empty"),
    (SYNCED, ("number",), "4", "number is '4'"),
    (SYNCED, ("kind",), "ready", "kind 'ready'"),
]


def read(message):
    readers = {"started": read_started, "points": read_points, "synced": read_number}
    return readers[kind_of(message)](message)


@pytest.mark.parametrize("message", [STARTED, POINTS, SYNCED, {"kind": "finished"}])
def test_the_schema_has_what_is_read(message):
    assert SCHEMA.is_valid(message)


@pytest.mark.parametrize(("message", "path", "value", "named"), WRONG)
def test_a_wrong_answer_is_refused_by_the_reader_and_by_the_schema(message, path, value, named):
    wrong = changed(message, path, value)
    with pytest.raises(DeviceError) as caught:
        read(wrong)
    assert named in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not SCHEMA.is_valid(wrong)


def test_tracks_of_different_lengths_are_refused():
    tracks = {"left": TRACK, "right": {"elevation": [1.0], "valid": [True]}}
    with pytest.raises(DeviceError, match="differ in length"):
        read_points({**POINTS, "tracks": tracks})


def test_points_lie_at_their_numbers_and_one_without_elevation_is_not_valid():
    valid = {"elevation": [0.25, None], "valid": [True, True]}
    points = read_points({**POINTS, "tracks": {"left": valid}})
    np.testing.assert_allclose(points.distance_m, [-0.3, -0.2])
    assert points.paths["left"].valid.tolist() == [True, False]
    assert np.isnan(points.paths["left"].elevation[1])


def test_a_device_without_provisional_points_or_standstills_says_so():
    started = read_started({**STARTED, "tolerance_m": 1e-6})
    assert started.latency.provisional_s is None
    assert started.latency.standing_s is None
    assert started.tolerance_m == 1e-6
