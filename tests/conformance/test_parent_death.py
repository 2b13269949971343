"""A judge that is killed leaves no process: neither its device, nor what that started, nor a pool.

The devices here ignore the end of their input and every signal that they can.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

pytestmark = [
    pytest.mark.posix,
    pytest.mark.skipif(
        not sys.platform.startswith("linux"), reason="only Linux ends a child with its parent"
    ),
]
STUBBORN = """
import os, signal, sys, time
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
    signal.signal(number, signal.SIG_IGN)
own = os.fork() if sys.argv[1] == "forking" else 0
if sys.argv[1] == "forking" and own == 0:
    os.setsid()
open(sys.argv[2] + str(os.getpid()), "w").close()
while True:
    time.sleep(3600)
"""
JUDGE = """
import sys, time
from collections.abc import Callable
from pathlib import Path
from floatref_conformance.devices.process import start
start([sys.executable, "-c", *sys.argv[1:]], Path.cwd())
time.sleep(3600)
"""
POOL = """
import os, sys, time
from floatref_conformance.worker_pool import worker_pool

def work(place):
    open(place + str(os.getpid()), "w").close()
    time.sleep(3600)

if __name__ == "__main__":
    with worker_pool(2) as pool:
        for each in [pool.submit(work, sys.argv[1]) for _ in range(2)]:
            each.result()
"""
NEXT = "from floatref_conformance.devices.descendants import Descendants; Descendants().end(None)"


def is_alive(pid: int) -> bool:
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False
    return text.rpartition(")")[2].split()[0] not in "ZX"


def wait_for(
    condition: Callable[[], bool], process: "subprocess.Popen[bytes] | None" = None
) -> None:
    end_s = time.monotonic() + 600.0
    while not condition():
        assert process is None or process.poll() is None
        assert time.monotonic() < end_s, "it never came to that"
        time.sleep(0.02)


def killed(words: list[str], folder: Path, count: int) -> list[int]:
    """Return the ``count`` processes that write their numbers into ``folder``.

    The first process was killed after that.
    """
    folder.mkdir(exist_ok=True)
    process = subprocess.Popen([sys.executable, *words])
    try:
        wait_for(lambda: len(os.listdir(folder)) == count, process)
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
    return [int(name) for name in os.listdir(folder)]


def end(processes: list[int]) -> None:
    for pid in filter(is_alive, processes):
        os.kill(pid, signal.SIGKILL)


def test_a_device_ends_with_a_judge_that_is_killed(tmp_path: Path) -> None:
    pids = tmp_path / "pids"
    found = killed(["-c", JUDGE, STUBBORN, "alone", f"{pids}/"], pids, 1)
    try:
        wait_for(lambda: not any(map(is_alive, found)))
    finally:
        end(found)


@pytest.mark.slow
def test_the_next_run_kills_what_a_device_left(tmp_path: Path) -> None:
    """The device forked, and its child left the session: no system ends that by itself."""
    pids = tmp_path / "pids"
    found = killed(["-c", JUDGE, STUBBORN, "forking", f"{pids}/"], pids, 2)
    try:
        subprocess.run([sys.executable, "-c", NEXT], check=True, timeout=600)
        wait_for(lambda: not any(map(is_alive, found)))
    finally:
        end(found)


@pytest.mark.slow
def test_the_devices_of_a_living_judge_stay(tmp_path: Path) -> None:
    pids = tmp_path / "pids"
    pids.mkdir()
    judge = subprocess.Popen([sys.executable, "-c", JUDGE, STUBBORN, "alone", f"{pids}/"])
    try:
        wait_for(lambda: len(os.listdir(pids)) == 1, judge)
        subprocess.run([sys.executable, "-c", NEXT], check=True, timeout=600)
        assert all(is_alive(int(name)) for name in os.listdir(pids))
    finally:
        judge.kill()
        judge.wait()


@pytest.mark.slow
def test_the_processes_of_a_pool_end_with_it(tmp_path: Path) -> None:
    (tmp_path / "pool.py").write_text(POOL, encoding="utf-8")
    pids = tmp_path / "pids"
    found = killed([str(tmp_path / "pool.py"), f"{pids}/"], pids, 2)
    try:
        wait_for(lambda: not any(map(is_alive, found)))
    finally:
        end(found)
