"""Take the pictures of docs/view.md: pages of `floatref view`, as Chromium shows them.

python .ci/view_pictures.py

The pages are those that the console block of docs/view.md makes. Pictures go to docs/images.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, sync_playwright

ROOT = Path(__file__).parents[1]
PAGE, IMAGES = ROOT / "docs" / "view.md", ROOT / "docs" / "images"
DESKTOP = {"viewport": {"width": 1000, "height": 1000}}
PHONE: dict[str, Any] = {
    "viewport": {"width": 390, "height": 780},
    "is_mobile": True,
    "has_touch": True,
    "device_scale_factor": 1.5,
}
SHOTS = (
    ("view-profiles", "road.html", DESKTOP, ""),
    ("view-zoomed", "road.html", DESKTOP, "showPart(306, 326)"),
    ("view-recording", "stop.html", DESKTOP, "choose('axis', 'distance')"),
    ("view-phone", "road.html", PHONE, "showPart(240, 420)"),
)


def make_pages(folder: Path) -> None:
    """Run the commands of the page's first console block in ``folder``."""
    block = PAGE.read_text(encoding="utf-8").split("```console\n")[1].split("```")[0]
    path = os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")])
    for line in block.splitlines():
        if line.startswith("$ "):
            words = ["bash", "-c", line[2:]]
            subprocess.run(words, cwd=folder, check=True, env={**os.environ, "PATH": path})


def shoot(browser: Browser, folder: Path) -> None:
    """Open every page, run its script and write the picture."""
    for name, file, view, script in SHOTS:
        page = browser.new_context(**view).new_page()
        page.goto((folder / file).as_uri())
        page.wait_for_function("performance.getEntriesByName('drawn').length > 0")
        if script:
            page.evaluate(script)
        page.wait_for_timeout(500)
        page.screenshot(path=IMAGES / f"{name}.png")


def main() -> None:
    """Make the pages and their pictures."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        sys.exit("no Chromium: run apt-get install chromium")
    with tempfile.TemporaryDirectory() as name, sync_playwright() as driver:
        make_pages(Path(name))
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        shoot(browser, Path(name))
        browser.close()


if __name__ == "__main__":
    main()
