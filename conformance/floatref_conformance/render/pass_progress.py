"""How far the passes of the table are, on stderr."""

from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn


class PassProgress:
    """A bar on a terminal, else one line for each set of passes; a context manager.

    Call it with the name of every pass before it is driven.
    """

    def __init__(self, total: int, console: Console | None = None) -> None:
        """Expect ``total`` passes; write to ``console``, or else to standard error."""
        self._console = console or Console(stderr=True, emoji=False)
        self._bar = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            TextColumn("{task.completed:.0f} of {task.total:.0f}"),
            TimeElapsedColumn(),
            console=self._console,
            transient=True,
            disable=not self._console.is_terminal,
        )
        self._task = self._bar.add_task("", total=total)
        self._started = 0
        self._set = ""

    def __enter__(self) -> "PassProgress":
        """Show the bar."""
        self._bar.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Take the bar away, also after an error."""
        self._bar.stop()

    def __call__(self, name: str) -> None:
        """Show that the pass ``name`` ("set: run") starts and those before are done."""
        self._bar.update(self._task, description=name, completed=self._started)
        self._started += 1
        group = name.partition(":")[0]
        if group != self._set and not self._console.is_terminal:
            self._console.print(f"{group} …", markup=False, highlight=False, soft_wrap=True)
        self._set = group
