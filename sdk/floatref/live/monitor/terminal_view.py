"""The view in a terminal, drawn again twice a second, or a plain line every ten seconds."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Event as Signal
from threading import Thread
from typing import TextIO

from rich.console import Console, RenderableType
from rich.live import Live

from floatref.live.monitor.shown_state import Shown
from floatref.live.monitor.state_tables import plain_line, render

DRAWS_S = 0.5
"""Time in s between two drawings."""
LINE_S = 10.0
"""Time in s between two plain lines."""
ENDING_S = 2.0
"""Longest time in s that the end of a run waits for a terminal that takes no output."""


@contextmanager
def terminal_view(shown: Callable[[], Shown], stream: TextIO) -> Iterator[None]:
    """Show on ``stream`` what ``shown`` returns, until the end of the statement.

    The last state is left there. Without a terminal it is one plain line every `LINE_S`. A thread
    of its own writes, so that a stream that takes no output stops that thread alone.
    """
    console = Console(file=stream, emoji=False, highlight=False)
    end = Signal()

    def write() -> None:
        # Whoever reads may have gone; the run goes on.
        with suppress(OSError, ValueError):
            if console.is_terminal:
                _draw(shown, console, end)
            else:
                _write_lines(shown, stream, end)

    thread = Thread(target=write, name="floatref-display", daemon=True)
    thread.start()
    try:
        yield
    finally:
        end.set()
        thread.join(ENDING_S)


def _draw(shown: Callable[[], Shown], console: Console, end: Signal) -> None:
    """Draw tables until the ``end``; standard output has the answers, so it is not redirected."""

    def draw() -> RenderableType:
        return render(shown())

    live = Live(
        console=console,
        get_renderable=draw,
        auto_refresh=False,
        redirect_stdout=False,
        vertical_overflow="crop",
    )
    with live:
        while not end.wait(DRAWS_S):
            live.refresh()


def _write_lines(shown: Callable[[], Shown], stream: TextIO, end: Signal) -> None:
    while not end.wait(LINE_S):
        print(plain_line(shown()), file=stream, flush=True)
    print(plain_line(shown()), file=stream, flush=True)
