"""Standard streams that whoever called has closed, as some schedulers of jobs do."""

import os
import sys

STREAMS = ("stdin", "stdout", "stderr")
"""Names in `sys`, in the order of the file descriptors 0, 1 and 2."""


def open_outputs() -> None:
    """Have what is closed of the standard streams lead nowhere.

    Else the next file that is opened would be taken for one, by us and by what we start.
    """
    while (number := os.open(os.devnull, os.O_RDWR)) < len(STREAMS):
        os.set_inheritable(number, True)
    os.close(number)
    for number, name in enumerate(STREAMS):
        if getattr(sys, name) is None:
            mode = "w" if number else "r"
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115
