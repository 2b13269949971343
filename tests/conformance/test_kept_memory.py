"""A process that keeps its memory takes few new pages for the next array of the same size."""

import subprocess
import sys

import pytest

PROGRAM = """
import resource, sys
from threading import Thread
import numpy as np
from floatref_conformance.kept_memory import keep_memory

def count_faults():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    np.empty(10_000_000).fill(1.0)
    faults.append(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)

faults = []
if "keep" in sys.argv and not keep_memory():
    sys.exit()
count_faults()
later = Thread(target=count_faults)
later.start()
later.join()
count_faults()
print(*faults)
"""


def _faults(*words: str) -> list[int]:
    """Return the page faults of three arrays, the second of them in a thread."""
    ran = subprocess.run(
        [sys.executable, "-c", PROGRAM, *words], capture_output=True, text=True, check=True
    )
    return [int(word) for word in ran.stdout.split()]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="about the allocator of glibc")
def test_the_next_array_takes_few_new_pages_in_any_thread():
    kept = _faults("keep")
    if not kept:
        pytest.skip("the allocator here has no such option")
    assert max(kept[1:]) < min(_faults()[1:]) / 2
