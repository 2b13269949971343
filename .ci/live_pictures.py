"""Take the pictures of docs/live-display.md: a run that is going on, in a terminal and on a page.

    python .ci/live_pictures.py

The drive is simulated; most of it is sent at once, and its last seconds as fast as it is driven.
Pictures go to docs/images.
"""

import importlib.util
import json
import os
import tempfile
import time
from io import StringIO
from pathlib import Path
from threading import Thread
from typing import Any

from rich.console import Console
from terminal import browser_page, command_line, picture

from floatref.live.monitor.page_server import page_server
from floatref.live.monitor.run_monitor import RunMonitor
from floatref.live.monitor.sensor_health import Health
from floatref.live.monitor.shown_state import Shown
from floatref.live.monitor.state_tables import render
from floatref.live.session.live_run import LiveRun
from floatref.live.session.serving import Peer, Serving

ROOT = Path(__file__).parents[1]
IMAGES, RUNS = ROOT / "docs" / "images", ROOT / "tests" / "sdk" / "live"
COMMAND = "logger | floatref live --out run --display > points.jsonl"
COLUMNS = 80
LEGS = [(20.0, 260.0)]
STEP_S, ENDS = 0.5, 60
"""Length of a message in s, and how many are sent as fast as they are driven."""
SILENT, STUCK = slice(330, 336), 0.31
WIDTHS = {"live-page": 1000, "live-phone": 390}


def load(path: Path) -> Any:
    """Return the module in the file ``path``."""
    spec = importlib.util.spec_from_file_location(f"of_{path.parent.name}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def messages() -> list[dict[str, Any]]:
    """Return a drive with samples that are never sent, and a laser that is stuck at the end."""
    recording = load(RUNS / "conftest.py").make_drive(LEGS, tracks=("left", "right"))
    more = {"pipeline": "road-prior-smoother", "provisional": True}
    found = load(RUNS / "session" / "conftest.py").messages_of(recording, STEP_S, **more)
    for each in found[SILENT]:
        del each["channels"]["left.height"]
    for each in found[-ENDS:-2]:
        piece = each["channels"]["right.height"]
        piece["values"] = [STUCK] * len(piece["values"])
    return list(found[:-2])


def serve(folder: Path, monitor: RunMonitor, stream: int) -> None:
    """Serve the run whose messages come from the pipe ``stream``."""
    run = LiveRun(folder / "run", False, watch=monitor)
    Serving(run, Peer(os.fdopen(stream, "rb"), len, "logger")).serve()


def send(stream: int, sent: list[dict[str, Any]], pause_s: float) -> None:
    """Write the messages to the pipe ``stream``."""
    for each in sent:
        data = json.dumps(each).encode() + b"\n"
        while data:
            data = data[os.write(stream, data) :]
        time.sleep(pause_s)


def is_telling(shown: Shown) -> bool:
    """Return whether there is much to see: final sections, and a sensor that is stuck."""
    finals = [section for section in shown.sections if section.is_final]
    stuck = [each for each in shown.sensors if each.health is Health.STUCK]
    return bool(finals and stuck and shown.to_final and shown.to_final.travel_m)


def take(shown: Shown) -> None:
    """Take the pictures of a state."""
    console = Console(record=True, file=StringIO(), width=COLUMNS, force_terminal=True)
    console.print(render(shown))
    form = "<pre>{code}</pre>"
    html = command_line(COMMAND) + console.export_html(inline_styles=True, code_format=form)
    picture(html, COLUMNS, IMAGES / "live-terminal.png")
    with page_server(lambda: shown, 0) as address:
        for name, width in WIDTHS.items():
            with browser_page(width) as opened:
                page = opened("")
                page.goto(address)
                page.wait_for_selector("#made:not(:empty)")
                page.screenshot(path=IMAGES / f"{name}.png", full_page=width > COLUMNS * 8)


def main() -> None:
    """Drive, and take the pictures near the end."""
    monitor, sent = RunMonitor("run"), messages()
    with tempfile.TemporaryDirectory() as name:
        reading, writing = os.pipe()
        Thread(target=serve, args=(Path(name), monitor, reading), daemon=True).start()
        send(writing, sent[:-ENDS], 0.0)
        while not any(section.is_final for section in monitor.shown().sections):
            time.sleep(0.5)
        Thread(target=send, args=(writing, sent[-ENDS:], STEP_S), daemon=True).start()
        while not is_telling(shown := monitor.shown()):
            time.sleep(0.1)
        take(shown)


if __name__ == "__main__":
    main()
