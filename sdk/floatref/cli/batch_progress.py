"""How far a batch is: a bar on a terminal, else a plain line now and then."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import timedelta
from math import isnan
from threading import Event, Thread
from time import monotonic
from typing import TYPE_CHECKING, TextIO

from floatref.batch.tally import Tally

if TYPE_CHECKING:
    from rich.console import Console

EVERY_S = 30.0
"""Between two plain lines."""

REFRESH_S = 5.0
"""Until a bar is drawn anew, with the number of workers."""


@contextmanager
def progress(
    tally: Tally, stream: TextIO, workers: Callable[[], int], every_s: float = EVERY_S
) -> Iterator[Callable[[], None]]:
    """Show ``tally`` on ``stream`` as it grows; yield what is to be called when it has."""
    from rich.console import Console

    console = Console(file=stream)
    if console.is_terminal:
        with _bar(tally, console) as show, _regularly(lambda: show(workers()), REFRESH_S):
            yield show
        return
    with _regularly(lambda: print(said(tally, workers()), file=stream, flush=True), every_s):
        yield lambda: None


@contextmanager
def _bar(tally: Tally, console: "Console") -> Iterator[Callable[..., None]]:
    """Yield what moves a bar to where ``tally`` is; it keeps the number of workers if given."""
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (BarColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(said(tally), total=1.0)
        known: list[int] = []

        def show(*workers: int) -> None:
            known[:] = workers or known
            bar.update(task, completed=tally.part, description=said(tally, *known))

        yield show


def said(tally: Tally, workers: int | None = None) -> str:
    """Return one line, what matters least last: a narrow terminal cuts it off."""
    now_s = monotonic()
    parts = [f"{tally.seen} of {tally.files} files", f"{len(tally.failed)} failed"]
    left_s = tally.left_s(now_s)
    if tally.processed and not isnan(left_s):
        parts.append(f"{duration(left_s)} left")
    if tally.processed:
        parts.append(f"{tally.files_per_minute(now_s):.1f} files/min")
        parts.append(f"{tally.km_per_hour(now_s):.1f} km/h")
    if tally.skipped:
        parts.append(f"{tally.skipped} done before")
    if workers is not None:
        parts.append("1 worker" if workers == 1 else f"{workers} workers")
    return ", ".join(parts)


def duration(seconds: float) -> str:
    """Return ``seconds`` as hours, minutes and seconds."""
    return str(timedelta(seconds=round(seconds)))


@contextmanager
def _regularly(act: Callable[[], None], every_s: float) -> Iterator[None]:
    """Call ``act`` every so often, also while no file comes to its end."""
    over = Event()

    def repeat() -> None:
        while not over.wait(every_s):
            act()

    other = Thread(target=repeat, daemon=True)
    other.start()
    try:
        yield
    finally:
        over.set()
        other.join(timeout=1.0)
