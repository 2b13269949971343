"""Measure ``floatref view`` and ``floatref plot`` of an hour with nine channels at 16 kHz.

Writes the recording in pieces to a temporary folder, makes page and picture in fresh processes,
then opens the page from disk in Chromium. Prints time and peak memory of both commands, the size of
the page, the time from navigation to the first drawing, and the time of a frame while panning
and zooming. Run as ``python tests/benchmarks/bench_view.py [--seconds 3600]`` with TMPDIR naming a
folder with room for 4.2 GB, and Chromium on the path.
"""

import argparse
import json
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from bench_memory import RATE_HZ, TRACKS, append, write_samples
from playwright.sync_api import sync_playwright
from timing import RUN

MORE = (
    ("longitudinal_specific_force", "m/s^2"),
    ("lateral_specific_force", "m/s^2"),
    ("roll_rate", "rad/s"),
    ("pitch_rate", "rad/s"),
)
PIECE = 1 << 20
PAN = """() => new Promise((done) => {
  const taken = [];
  showPart(0, 60);
  const step = (before) => requestAnimationFrame((now) => {
    if (before) taken.push(now - before);
    if (taken.length >= 120) return done(taken.slice(5));
    taken.length % 3 ? move(0.02) : zoom(1.03);
    step(now);
  });
  step(0);
})"""
DRAW = "() => { const begin = performance.now(); drawNow(); return performance.now() - begin; }"


def write_recording(folder: Path, seconds: float) -> None:
    """Write nine channels of ``seconds`` and the document that lists them."""
    folder.mkdir()
    write_samples(folder, seconds)
    rng, count = np.random.default_rng(1), round(seconds * RATE_HZ)
    for first in range(0, count, PIECE):
        for name, _ in MORE:
            append(folder / f"{name}.f64", rng.standard_normal(min(PIECE, count - first)))
    clock = {"rate_hz": RATE_HZ, "start_s": 0.0}
    channels = [{"name": "distance", "unit": "m", "file": "distance.f64", **clock}]
    for track in TRACKS:
        for name, unit in (("vertical_specific_force", "m/s^2"), ("height", "m")):
            entry = {"name": name, "unit": unit, "track": track, "file": f"{track}.{name}.f64"}
            channels.append({**entry, **clock})
    channels += [{"name": n, "unit": u, "file": f"{n}.f64", **clock} for n, u in MORE]
    document = {"format": "floatref-recording/1", "channels": channels}
    (folder / "recording.json").write_text(json.dumps(document))


def run(*arguments: str) -> tuple[float, float]:
    """Run a command; return its seconds and its peak resident memory in MB."""
    timed = "import resource, subprocess, sys; c = subprocess.run(sys.argv[1:]).returncode; "
    timed += "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(c)"
    begin = time.perf_counter()
    words = [sys.executable, "-c", timed, sys.executable, "-c", RUN, *arguments]
    done = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=True)
    peak = float(done.stdout.split()[-1]) * (1 if sys.platform == "darwin" else 1024)
    return time.perf_counter() - begin, peak / 1e6


def open_page(page_file: Path) -> dict[str, float]:
    """Return seconds to the first drawing, and ms of a frame and of a drawing while moving."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1400, "height": 1000})
        begin = time.perf_counter()
        page.goto(page_file.as_uri())
        page.wait_for_function("performance.getEntriesByName('drawn').length > 0")
        opened = time.perf_counter() - begin
        frames = page.evaluate(PAN)
        drawing = [page.evaluate(DRAW) for _ in range(20)]
        browser.close()
    return {
        "open_s": opened,
        "frame_ms": statistics.median(frames),
        "longest_frame_ms": max(frames),
        "draw_ms": statistics.median(drawing),
    }


def main() -> None:
    """Write, make, open, and print one line for each figure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=3600.0)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="floatref-view-") as name:
        folder = Path(name)
        write_recording(folder / "hour", given.seconds)
        figures: dict[str, float] = {}
        page, picture = folder / "hour.html", folder / "hour.png"
        figures["view_s"], figures["view_peak_mb"] = run(
            "view", str(folder / "hour"), "-o", str(page)
        )
        figures["plot_s"], figures["plot_peak_mb"] = run(
            "plot", str(folder / "hour"), "-o", str(picture)
        )
        figures["size_mb"] = page.stat().st_size / 1e6
        figures |= open_page(page)
    for figure, value in figures.items():
        print(f"{figure:18} {value:8.2f}")


if __name__ == "__main__":
    main()
