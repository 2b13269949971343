"""Processes that end with the process that started them, however that ends.

On Linux the system kills a child whose parent has died. It means the thread that started the child:
so a thread that may end before its child does not ask for it. A child of a child is not killed; the
next run finds it by its mark, see `devices.descendants`. Other systems have no such service.
"""

import ctypes
import os
import signal
import sys
from collections.abc import Callable
from multiprocessing import parent_process
from threading import Thread, current_thread, main_thread

PR_SET_PDEATHSIG = 1
GONE = 1
"""Exit code of a process whose parent has died."""

# Looked up before any fork: a new child of a process with threads may not load anything.
_prctl = ctypes.CDLL(None).prctl if sys.platform.startswith("linux") else None


def killed_with_parent() -> Callable[[], None] | None:
    """Return what a child has to call before its program starts; None if it needs nothing.

    The thread that calls this has to start the child.
    """
    if _prctl is None or current_thread() is not main_thread():
        return None
    prctl, parent = _prctl, os.getpid()

    def ask() -> None:
        prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
        # It may have died before the question.
        if os.getppid() != parent:
            os._exit(GONE)

    return ask


def end_with_parent() -> None:
    """End this process of a pool as soon as its parent has died, on any system."""
    Thread(target=_wait_for_parent, daemon=True).start()


def _wait_for_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(GONE)
