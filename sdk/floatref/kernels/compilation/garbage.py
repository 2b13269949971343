"""No search for unreachable objects while numba compiles: it makes millions that live on.

The search of Python's collector through them takes a tenth of a compilation.
"""

import gc
from threading import Lock
from typing import Any


class CollectorPause:
    """Stops the collector while at least one compilation runs, if it ran before."""

    def __init__(self) -> None:
        """Begin without a compilation."""
        self._running, self._was_on, self._lock = 0, False, Lock()

    def begin(self) -> None:
        """Count a compilation that begins."""
        with self._lock:
            if not self._running:
                self._was_on = gc.isenabled()
                gc.disable()
            self._running += 1

    def end(self) -> None:
        """Count one that ends."""
        with self._lock:
            self._running -= 1
            if not self._running and self._was_on:
                gc.enable()


def pause_collector(event: Any) -> None:
    """Have the collector pause in every compilation from now on; ``event`` is numba's module."""
    pause = CollectorPause()
    begin_and_end = {"on_start": lambda *_: pause.begin(), "on_end": lambda *_: pause.end()}
    event.register("numba:compile", type("Pauses", (event.Listener,), begin_and_end)())
