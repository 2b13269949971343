"""All probes together have a limit in time, which no device can stretch."""

from types import SimpleNamespace

import pytest

from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceHung
from floatref_conformance.resemblance.probe_answers import ProbesTooLong, ask_probes

KNOWN = Description("a", "1", "temporal", ())
DISTANCE = Channel.of("distance", [20.0 * t for t in range(11)], UniformClock.of(1.0))
TAKEN = SimpleNamespace(recording=Recording((DISTANCE,), Setup(0.05)))
PROBE = SimpleNamespace(name="road", take=lambda _: TAKEN)


class Hanging:
    """A device that notes how long it was given, and does not answer in that time."""

    def __init__(self, timeout_s=None):
        self.timeout_s, self.given = timeout_s, []

    def run(self, *_):
        self.given.append(self.timeout_s)
        raise DeviceHung("no answer")


def test_no_probe_begins_when_the_time_is_over():
    device = Hanging()
    with pytest.raises(ProbesTooLong):
        next(ask_probes(device, KNOWN, [PROBE], longest_s=0.0))
    assert device.given == []


@pytest.mark.parametrize(
    ("own", "longest_s", "given"),
    [(None, 9e9, 80.0), (None, 70.0, 70.0), (7.0, 70.0, 7.0), (600.0, 70.0, 70.0)],
)
def test_a_probe_gets_the_time_that_is_left_or_its_own(own, longest_s, given):
    """Its own time is 60 s and twice its length, which is 10 s, or that of `--device-timeout`."""
    device = Hanging(own)
    (answer,) = ask_probes(device, KNOWN, [PROBE, PROBE], longest_s=longest_s)
    assert answer.fault == "no answer"
    (limit_s,) = device.given
    assert given - 60.0 < limit_s <= given
    assert limit_s == given or given == longest_s
    assert device.timeout_s == own
