"""A bar on the terminal for long work; nothing where stderr is no terminal."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def progress_bar(
    label: str, quiet: bool, before: str | None = None
) -> Iterator[Callable[[float], None] | None]:
    """Yield what shows the part that is done, from 0 to 1; None where nothing is shown.

    ``before`` stands there until it is called for the first time.
    """
    from rich.console import Console
    from rich.progress import Progress

    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield None
        return
    with Progress(console=console, transient=True) as bar:
        task = bar.add_task(before or label, total=1.0)

        def show(done: float) -> None:
            bar.update(task, completed=done, description=label)

        yield show
