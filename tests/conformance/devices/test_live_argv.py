"""Who streams: what declares it, by the same command line."""

import sys

import pytest

from floatref_conformance.devices.executable import ExecDevice
from floatref_conformance.errors import DeviceError

DESCRIBES = """
import json, sys
open("starts", "a").write("once ")
device = {"name": "x", "version": "1", "architecture": "temporal", "capabilities": []}
device.update(json.loads(sys.argv[1]))
for line in sys.stdin:
    asked = json.loads(line)
    if asked["cmd"] == "stop":
        break
    print(json.dumps({"seq": asked["seq"], "version": 1, "device": device}), flush=True)
"""


@pytest.fixture
def device(tmp_path):
    """Return a maker of devices that describe themselves with these members more."""
    made = []

    def make(members):
        argv = (sys.executable, "-c", DESCRIBES, members)
        made.append(ExecDevice(argv, tmp_path, start_s=600.0, stop_s=600.0))
        return made[-1]

    yield make
    for each in made:
        each.close()


@pytest.mark.parametrize(("members", "streams"), [("{}", 0), ('{"streaming": true}', 1)])
def test_a_program_streams_by_its_own_command_line_if_it_says_so(device, members, streams):
    program = device(members)
    assert program.live_argv == (program.argv if streams else None)


def test_anything_but_true_or_false_is_a_fault(device):
    with pytest.raises(DeviceError, match="streaming 'yes'; give true or false"):
        _ = device('{"streaming": "yes"}').live_argv


def test_a_program_that_was_stopped_is_not_started_again_to_be_asked(device, tmp_path):
    program = device('{"streaming": true}')
    program.describe()
    program.close()
    assert program.live_argv == program.argv
    assert (tmp_path / "starts").read_text(encoding="ascii") == "once "
