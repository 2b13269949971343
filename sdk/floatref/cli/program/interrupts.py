"""Signals that end a command as an exception of its own, and the exit code that it then has.

Nothing but a few modules of Python is imported here: this is loaded before all else.
"""

import _thread
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from threading import current_thread, main_thread
from time import monotonic, sleep
from types import FrameType
from typing import Any, NoReturn

INTERRUPTED = 130
"""Exit code of every command that was interrupted, as shells have it: 128 and SIGINT."""
TIDYING_S = 10.0
"""Time in s after a signal in which others are ignored, so that files can be removed."""
AGAIN_S = 0.01
"""Time in s after which a signal comes again that Python would have lost."""
SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
"""Ctrl-C, the end that a system or a batch queue asks for, and a terminal that was closed."""

LOADING = ("_raw_object_cache_notify", "_raw_object_cache_getbuffer")
"""Functions of llvmlite that LLVM calls for the code of a kernel. What is raised in them is dropped
as well, and before it can come again numba has written through an address that is 0."""
WHOLE = (*LOADING, "take_whole", "append_whole")
"""Names of all functions that no signal interrupts: these, and those of `floatref.live` between
whose statements samples would be taken but not counted. They wait for nothing."""


class Interrupt(KeyboardInterrupt):
    """Ctrl-C in a command.

    `python -m` dies of the signal in the end, whatever its exit code, if an exception of the very
    type KeyboardInterrupt has left a text that was run, as that of a named tuple.
    """


class Ending(SystemExit):
    """The end of the program by a signal."""


class EndHandler:
    """Calls ``act`` for a signal; what comes within `TIDYING_S` after it is ignored."""

    _deaf_until_s = 0.0

    def __init__(self, act: Callable[[], NoReturn]) -> None:
        """Remember what to do."""
        self._act, self._number = act, 0

    def __call__(self, number: int, frame: FrameType | None = None) -> None:
        """Act, unless the files of what another handler has ended are being removed."""
        outside_of_whole(self._end)(number, frame)

    def _end(self, number: int) -> None:
        now_s = monotonic()
        if now_s >= EndHandler._deaf_until_s:
            EndHandler._deaf_until_s = now_s + TIDYING_S
            self._number = number
            self._act()

    def act_again(self) -> bool:
        """Act in a moment, since what was raised has been dropped; return whether it did raise."""
        if self._number:
            EndHandler.begin()
            send_again(self._number)
        return self._number != 0

    @staticmethod
    def begin() -> None:
        """Begin another program, for which no signal has come yet."""
        EndHandler._deaf_until_s = 0.0


@contextmanager
def raised_again(again: Callable[[], bool]) -> Iterator[None]:
    """Call ``again`` where Python drops what a signal has raised.

    It drops what is raised in a callback of the garbage collector or of a weak reference, and in a
    finalizer; hypothesis, for one, has such a callback. Where ``again`` returns that another
    handler has raised it, and for all else that is dropped, the hook of before is called.
    """
    before = sys.unraisablehook

    def hook(dropped: "sys.UnraisableHookArgs") -> None:
        if not (isinstance(dropped.exc_value, (Interrupt, Ending)) and again()):
            before(dropped)

    sys.unraisablehook = hook
    try:
        yield
    finally:
        if sys.unraisablehook is hook:
            sys.unraisablehook = before


def outside_of_whole(act: Callable[[int], None]) -> Callable[[int, FrameType | None], None]:
    """Return a handler that calls ``act``, unless a function of `WHOLE` is at work.

    The signal comes again in a moment then.
    """

    def handle(number: int, frame: FrameType | None) -> None:
        while frame is not None and frame.f_code.co_name not in WHOLE:
            frame = frame.f_back
        (act if frame is None else send_again)(number)

    return handle


def send_again(number: int) -> None:
    """Send the signal ``number`` to this program in a moment."""
    # A plain thread: a lock may be held here. At the end of Python there are no more.
    with suppress(RuntimeError):
        _thread.start_new_thread(_send, (number,))


def _send(number: int) -> None:
    sleep(AGAIN_S)
    if hasattr(signal, "pthread_kill"):
        # A call of the system in which the main thread waits ends by it.
        signal.pthread_kill(main_thread().ident or 0, number)
    else:
        signal.raise_signal(number)


def raise_interrupt(*_: object) -> NoReturn:
    """Raise Interrupt, for a signal."""
    raise Interrupt


@contextmanager
def raising_interrupt() -> Iterator[None]:
    """Let the signals of `SIGNALS` raise Interrupt where they would end the program otherwise."""
    with _handled_by(EndHandler(raise_interrupt)):
        yield


@contextmanager
def ending_program(line: str) -> Iterator[None]:
    """Let these signals end the program with ``line`` on stderr and `INTERRUPTED`.

    For all that runs before and after a command: an Interrupt that click catches outside of a
    command is `Aborted!` and exit code 1.
    """

    def end() -> NoReturn:
        sys.stderr.write(f"{line}\n")
        raise Ending(INTERRUPTED)

    with _handled_by(EndHandler(end)):
        yield


@contextmanager
def _handled_by(handler: EndHandler) -> Iterator[None]:
    """Use ``handler`` for signals that nobody else handles or ignores."""
    before: dict[int, Any] = {}
    if current_thread() is main_thread():
        before = {number: signal.getsignal(number) for number in SIGNALS}
        before = {number: old for number, old in before.items() if _is_usual(old)}
    if not any(isinstance(old, EndHandler) for old in before.values()):
        EndHandler.begin()
    try:
        for number in before:
            signal.signal(number, handler)
        with raised_again(handler.act_again) if before else nullcontext():
            yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)


def _is_usual(handler: Any) -> bool:
    """Return whether ``handler`` is Python's or the system's, or that of `ending_program`."""
    return handler in (signal.default_int_handler, signal.SIG_DFL) or isinstance(
        handler, EndHandler
    )
