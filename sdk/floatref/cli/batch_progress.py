"""How far a batch is: a bar on a terminal, else a plain line now and then."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import timedelta
from math import isnan
from threading import Event, Thread
from time import monotonic
from typing import TextIO

from floatref.batch.tally import Tally

EVERY_S = 30.0
"""Between two plain lines."""


@contextmanager
def progress(
    tally: Tally, stream: TextIO, workers: Callable[[], int], every_s: float = EVERY_S
) -> Iterator[Callable[[], None]]:
    """Show ``tally`` on ``stream`` as it grows; yield what is to be called when it has."""
    from rich.console import Console

    console = Console(file=stream)
    if console.is_terminal:
        from rich.progress import BarColumn, Progress, TextColumn

        columns = (BarColumn(), TextColumn("{task.description}"))
        with Progress(*columns, console=console, transient=True) as bar:
            task = bar.add_task("starting", total=1.0)
            yield lambda: bar.update(task, completed=tally.part, description=said(tally))
        return
    with _told_regularly(lambda: f"{said(tally)}, {workers()} workers", stream, every_s):
        yield lambda: None


def said(tally: Tally) -> str:
    """Return one line: files, failures, rate and time left."""
    now_s = monotonic()
    parts = [f"{tally.seen} of {tally.files} files", f"{len(tally.failed)} failed"]
    if tally.skipped:
        parts.append(f"{tally.skipped} done before")
    if tally.processed:
        parts.append(f"{tally.files_per_minute(now_s):.1f} files/min")
        parts.append(f"{tally.km_per_hour(now_s):.1f} km/h")
    left_s = tally.left_s(now_s)
    if tally.processed and not isnan(left_s):
        parts.append(f"{duration(left_s)} left")
    return ", ".join(parts)


def duration(seconds: float) -> str:
    """Return ``seconds`` as hours, minutes and seconds."""
    return str(timedelta(seconds=round(seconds)))


@contextmanager
def _told_regularly(line: Callable[[], str], stream: TextIO, every_s: float) -> Iterator[None]:
    over = Event()

    def tell() -> None:
        while not over.wait(every_s):
            print(line(), file=stream, flush=True)

    teller = Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield
    finally:
        over.set()
        teller.join(timeout=1.0)
