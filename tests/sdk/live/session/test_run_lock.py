"""A run is served by one command at a time; a killed one does not lock it."""

import subprocess
import sys

import pytest

from floatref import InputError
from floatref.live.session.live_run import LiveRun
from floatref.live.session.messages import read_message
from floatref.live.session.run_lock import RunLock

HOLD = (
    "import sys, fcntl, os; f = os.open(sys.argv[1], 0); fcntl.flock(f, 2); print(flush=True); "
    "input()"
)


@pytest.fixture(scope="module")
def hello(drive, live):
    return read_message(live.hello_of(drive([(20.0, 10.0)], rate_hz=50.0)), "line")


def test_a_run_that_is_served_is_not_resumed(hello, tmp_path):
    first = LiveRun(tmp_path / "run", False)
    list(first.greet(hello))
    for _ in range(2):
        with pytest.raises(InputError, match="another command serves this run") as refused:
            LiveRun(tmp_path / "run", True)
        assert str(refused.value).count("\n") == 0
    first.close()
    second = LiveRun(tmp_path / "run", True)
    with pytest.raises(InputError, match="another command serves this run"):
        LiveRun(tmp_path / "run", True)
    second.close()
    LiveRun(tmp_path / "run", True).close()


def test_a_directory_that_cannot_be_resumed_is_not_locked(tmp_path):
    for _ in range(2):
        with pytest.raises(InputError, match="no live run to resume"):
            LiveRun(tmp_path, True)
    RunLock(tmp_path / "missing").release()


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such locks")
def test_the_lock_of_a_killed_process_is_free(tmp_path):
    other = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    with other:
        other.stdout.readline()
        with pytest.raises(InputError, match="another command serves this run"):
            RunLock(tmp_path)
        other.kill()
        other.wait(60)
        RunLock(tmp_path).release()
