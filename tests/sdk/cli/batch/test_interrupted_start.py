"""`floatref batch` that is interrupted while its workers start: one line, and nothing left."""

import os
import signal
from typing import Any

import pytest

pytestmark = [
    pytest.mark.slow,
    pytest.mark.posix,
    pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks at processes"),
]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("started", [1, 2, 3])
def test_no_traceback_however_far_the_start_is(
    bench: Any, number: signal.Signals, started: int
) -> None:
    """``started`` is the number of processes that there are already, the command included."""
    bench.put(w=("wait", 300))
    process = bench.batch("--jobs", "2")
    bench.wait_until(lambda: bench.out.exists() and len(bench.processes_of(process.pid)) >= started)
    os.killpg(process.pid, number)
    code, out, err = bench.ended(process)
    assert (code, out) == (130, "")
    assert err.startswith("Interrupted")
    assert "\n" not in err
    bench.wait_until(lambda: bench.processes_of(process.pid) == [])
    assert list(bench.temporary.iterdir()) == []
