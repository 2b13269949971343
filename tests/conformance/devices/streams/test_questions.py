"""Messages to a device: numbers come back bit for bit, gaps are null, clocks are stated."""

import json

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.files.recording_directory import setup_of
from floatref_conformance.devices.streams.questions import Part, say_hello, write, write_samples


def test_a_hello_states_setup_and_clock_of_every_channel(recording):
    hello = json.loads(write(say_hello(recording)))
    assert setup_of(hello["setup"]) == recording.setup
    named = {(entry["name"], entry.get("track")): entry for entry in hello["channels"]}
    for channel in recording.channels:
        entry = named[channel.id.name, channel.id.track]
        if channel.id.name == "distance":
            assert "rate_hz" not in entry
        else:
            assert entry["rate_hz"] == float(channel.clock.rate)
            assert entry["start_s"] == channel.clock.start_s


@given(st.lists(st.floats(allow_infinity=False), min_size=1), st.integers(0, 10**9))
def test_samples_come_back_bit_for_bit(values, first):
    x = np.array(values)
    message = json.loads(write_samples({"left.height": Part(first, x, x)}))
    found = message["channels"]["left.height"]
    assert found["first"] == first
    for key in ("values", "times_s"):
        np.testing.assert_array_equal(np.array(found[key], dtype=float), x)
