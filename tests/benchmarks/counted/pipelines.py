"""Run pipelines on two lengths of `bench_pipelines`, so that callgrind counts each.

Called by `instructions.py` with the library of `marks.c`, or ``-`` to compile the kernels alone,
and the names of pipelines.
"""

import ctypes
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from bench_pipelines import RATE_HZ, recording

import floatref
from floatref.intake.blocks import BLOCK

BLOCKS = 1, 3
"""Lengths in blocks. The first call of each length loads what the second needs as well."""


def main(library: str, names: list[str]) -> None:
    """Process each length once to warm up, and once for the count."""
    marks = None if library == "-" else ctypes.CDLL(library)
    drives = [recording(count * BLOCK / RATE_HZ) for count in BLOCKS]
    for name in names:
        for drive, count in zip(drives, BLOCKS, strict=True):
            floatref.process(drive, name)
            if marks is not None:
                marks.counted_start()
                floatref.process(drive, name)
                marks.counted_stop(f"{name} rate {RATE_HZ:.0f} samples {count * BLOCK}".encode())


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
