"""Calls of a library that may never return, with an end."""

from collections.abc import Callable
from queue import Empty, SimpleQueue
from threading import Thread
from time import monotonic
from typing import TypeVar

Answer = TypeVar("Answer")

STEP_S = 0.5
"""Time in s between two questions whether a call has to be given up."""


def call_until(ask: Callable[[], Answer], is_over: Callable[[], bool]) -> Answer:
    """Return what ``ask`` returns, or raise what it raises; TimeoutError once ``is_over``.

    A call that is given up goes on in a thread which does not keep the process from ending.
    """
    answers: SimpleQueue[tuple[Answer | None, BaseException | None]] = SimpleQueue()

    def run() -> None:
        try:
            answers.put((ask(), None))
        except BaseException as error:
            answers.put((None, error))

    Thread(target=run, daemon=True).start()
    while True:
        try:
            answer, error = answers.get(timeout=STEP_S)
        except Empty:
            if is_over():
                raise TimeoutError("no answer in time") from None
            continue
        if error is not None:
            raise error
        return answer  # type: ignore[return-value]  # Without an error it is the answer.


def call_within(ask: Callable[[], Answer], limit_s: float) -> Answer:
    """Return what ``ask`` returns; TimeoutError if it does not within ``limit_s`` seconds."""
    end_s = monotonic() + limit_s
    return call_until(ask, lambda: monotonic() > end_s)
