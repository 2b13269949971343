"""What a command shows in a terminal, and a picture of it."""

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import sysconfig
import termios
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from html import escape
from io import StringIO
from pathlib import Path
from shutil import which

from playwright.sync_api import Page, sync_playwright
from rich.console import Console
from rich.text import Text

MOVES = re.compile(r"\x1b\[[0-9;?]*[A-HJKSTfhlsu]|\x1b\][^\x07]*\x07")
"""Sequences that move the cursor or clear a line; those of colours end in m."""
SPARE = 4
FORM = """<!doctype html><meta charset="utf-8"><style>
body {{ margin: 0; background: #fff; color: #16202a; }}
pre {{ margin: 14px 18px; font: 15px/20px "DejaVu Sans Mono", monospace;
  width: {columns}ch; white-space: pre-wrap; overflow-wrap: anywhere; }}
hr {{ border: 0; border-top: 1px solid #aaa; margin: 4px 18px; }}
</style>{body}"""


def environment(cache: Path) -> dict[str, str]:
    """Return the environment in which this Python's commands are found, with a cache of its own."""
    path = os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")])
    colours = {"TERM": "xterm-256color", "COLORTERM": "truecolor"}
    return {**os.environ, "PATH": path, "FLOATREF_CACHE": str(cache), **colours}


def run_in_terminal(command: str, folder: Path, columns: int) -> str:
    """Return what ``command`` writes to a terminal of ``columns``, colours and moves included."""
    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
    words = ["bash", "-c", command]
    where = environment(folder / ".cache") | {"COLUMNS": str(columns)}
    running = subprocess.Popen(words, cwd=folder, env=where, stdin=its, stdout=its, stderr=its)
    os.close(its)
    text = b"".join(_pieces(ours))
    os.close(ours)
    running.wait()
    return text.decode("utf-8", "replace")


def _pieces(stream: int) -> Iterator[bytes]:
    while True:
        try:
            piece = os.read(stream, 1 << 16)
        except OSError:
            # Linux reports the end of what a terminal's other side writes as an error.
            return
        if not piece:
            return
        yield piece


def frames(shown: str, holding: str) -> list[str]:
    """Return the states of a line that is written over and over, those with ``holding`` in them."""
    plain = MOVES.sub("", shown)
    return [line for line in re.split(r"[\r\n]+", plain) if holding in line]


def without_frames(shown: str, holding: str) -> str:
    """Return what stays: all lines but those with ``holding``."""
    lines = MOVES.sub("", shown).replace("\r\n", "\n").split("\n")
    kept = [line.rpartition("\r")[2].rstrip() for line in lines]
    return "\n".join(line for line in kept if holding not in line).strip("\n")


def as_html(shown: str) -> str:
    """Return text with the colours of a terminal as HTML."""
    console = Console(record=True, file=StringIO(), width=400, force_terminal=True)
    for line in shown.splitlines():
        console.print(Text.from_ansi(line), soft_wrap=True)
    return console.export_html(inline_styles=True, code_format="<pre>{code}</pre>")


def command_line(command: str) -> str:
    """Return the line on which ``command`` is typed."""
    return f"<pre>$ {escape(command)}</pre>"


@contextmanager
def browser_page(width: int, scale: float = 1.0) -> Iterator[Callable[[str], Page]]:
    """Yield what opens an address, or HTML, in a headless Chromium ``width`` pixels wide."""
    chromium = which("chromium") or which("chromium-browser")
    if chromium is None:
        sys.exit("no Chromium: run apt-get install chromium")
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        view = {"width": width, "height": 800}

        def opened(source: str) -> Page:
            page = browser.new_context(viewport=view, device_scale_factor=scale).new_page()
            page.goto(source) if source.startswith("file:") else page.set_content(source)
            return page

        yield opened
        browser.close()


def picture(body: str, columns: int, path: Path) -> None:
    """Write HTML as a terminal of ``columns`` shows it to ``path``; longer lines go on below."""
    # A name that was replaced by a longer one may go on behind the terminal's last column.
    wide = columns + SPARE
    with browser_page(round(9.04 * wide) + 36) as opened:
        form = FORM.format(body=body, columns=wide)
        opened(form).screenshot(path=path, full_page=True)
