"""Memory of processes: their own pages count, those of children too, and an ended one has none."""

import subprocess
import sys
from pathlib import Path

import pytest

from floatref_conformance.devices.streams.resident_memory import memory_of

TAKES = """
import subprocess, sys
held = b"x" * (int(sys.argv[1]) << 20)
child = None
if len(sys.argv) > 2:
    child = subprocess.Popen([sys.executable, "-c", sys.argv[3], sys.argv[2]], stdin=sys.stdin,
                             stdout=subprocess.PIPE)
    child.stdout.readline()
print("ready", flush=True)
sys.stdin.read()
"""
pytestmark = pytest.mark.skipif(
    not Path("/proc/self/status").is_file(), reason="memory is read from /proc"
)


def measured(*words):
    """Return the memory in MiB of a process that takes so many MiB, with a child if two."""
    command = [sys.executable, "-c", TAKES, *words]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        process.stdout.readline()
        size = memory_of(process.pid)
        process.stdin.close()
        process.wait(600)
    assert memory_of(process.pid) is None
    return size / 2**20


def test_what_a_process_takes_is_seen():
    assert 90.0 <= measured("96") - measured("1") <= 100.0


@pytest.mark.slow
def test_what_its_children_take_is_seen_as_well():
    assert 180.0 <= measured("96", "96", TAKES) - measured("1", "1", TAKES) <= 200.0
