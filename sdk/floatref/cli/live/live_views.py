"""`floatref live --display` and `--web`: who looks on, in the terminal and in a browser."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from floatref.errors import InputError
from floatref.files import read_profile

if TYPE_CHECKING:
    from floatref.live.monitor.run_monitor import RunMonitor

LAST_PORT = 65_535


def make_monitor(out: Path, display: bool, web: int | None) -> "RunMonitor | None":
    """Return what follows the run that is made at ``out``; None without a view.

    Raises InputError for ``web``, the port of the page, that is no port, 0 for a free one.
    """
    if web is not None and not 0 <= web <= LAST_PORT:
        raise InputError(f"--web is {web}; give a port from 0 to {LAST_PORT}")
    if not display and web is None:
        return None
    # A run without a view does not load what draws.
    from floatref.live.monitor.run_monitor import RunMonitor

    monitor = RunMonitor(out.name)
    # A run that is resumed has points.
    if (out / "profile.json").exists():
        monitor.recall(read_profile(out))
    return monitor


@contextmanager
def open_views(
    monitor: "RunMonitor | None", display: bool, web: int | None, say: Callable[[str], None]
) -> Iterator[None]:
    """Show ``monitor`` until the end of the statement.

    The address of a page goes to ``say``. Raises InputError for a port that cannot be opened.
    """
    if monitor is None:
        yield
        return
    from floatref.live.monitor.page_server import page_server
    from floatref.live.monitor.terminal_view import terminal_view

    with ExitStack() as views:
        if web is not None:
            say(f"Page at {views.enter_context(page_server(monitor.shown, web))}")
        if display:
            views.enter_context(terminal_view(monitor.shown, sys.stderr))
        yield
