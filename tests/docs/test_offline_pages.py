"""A page opens in a browser without a network, with its equations and their letters.

That equations are typeset and that nothing is loaded from elsewhere is held without a browser too,
in `test_site.py`: only what a browser makes of it is looked at here.
"""

import html
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
BROWSER = next(filter(None, map(shutil.which, BROWSERS)), None)
PAGES = ["road-prior-model.html", "slips.html", "matched-high-pass.html"]
REPORT = """
<script>
addEventListener("load", () => document.fonts.ready.then(() => {
  const ready = [...document.fonts].filter(font => font.status == "loaded");
  const fonts = ready.map(font => font.family);
  const asked = performance.getEntriesByType("resource").map(entry => entry.name);
  const wide = document.documentElement.scrollWidth - innerWidth;
  const broken = [...document.images].filter(image => !image.naturalWidth).map(image => image.src);
  document.body.dataset.report = JSON.stringify({fonts, asked, wide, broken});
}));
</script>
"""


def opened(page: Path, scratch: Path, width: int) -> str:
    """Return the document that the browser makes of ``page``, from its file, without a network."""
    copy = page.with_name(f"opened-{page.name}")
    copy.write_text(page.read_text("utf-8").replace("</body>", f"{REPORT}</body>"), "utf-8")
    assert BROWSER is not None
    options = [
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-background-networking",
        "--host-resolver-rules=MAP * ~NOTFOUND",
        f"--user-data-dir={scratch}",
        f"--window-size={width},900",
        "--virtual-time-budget=5000",
        "--dump-dom",
    ]
    return subprocess.run(
        [BROWSER, *options, copy.as_uri()], capture_output=True, text=True, check=True, timeout=600
    ).stdout


@pytest.mark.slow
@pytest.mark.skipif(BROWSER is None, reason=f"none of {', '.join(BROWSERS)} is installed")
@pytest.mark.parametrize("name", PAGES)
@pytest.mark.parametrize("width", [1280, 500])
def test_a_page_opens_offline_with_its_equations(
    site: Path, tmp_path: Path, name: str, width: int
) -> None:
    found = opened(site / name, tmp_path, width)
    written = (site / name).read_text(encoding="utf-8").count('<span class="katex">')
    assert found.count('<span class="katex">') == written > 20
    assert "katex-error" not in found
    (text,) = re.findall(r'data-report="(.*?)"', found)
    report = json.loads(html.unescape(text))
    assert {"KaTeX_Main", "KaTeX_Math"} <= set(report["fonts"])
    assert [name for name in report["asked"] if not name.startswith(("file:", "data:"))] == []
    assert report["broken"] == []
    assert report["wide"] <= 0
