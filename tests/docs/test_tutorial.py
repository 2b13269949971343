"""The tutorial, pages of commands, and the example of a vendor's tests run as they stand."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "docs" / "examples" / "vendor_tests"


def test_the_example_passes_under_plain_pytest(tmp_path):
    (tmp_path / "test_ours.py").write_text((EXAMPLE / "test_our_profiler.py").read_text())
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-o", "addopts="]
    done = subprocess.run(
        [*words, str(tmp_path)], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "passed" in done.stdout
    assert "13 skipped" in done.stdout


def test_the_page_shows_the_example_as_it_is():
    page = (EXAMPLE.parents[1] / "your-own-tests.md").read_text()
    shown = page.split("```python\n")[1:]
    assert len(shown) == 2
    for block in shown:
        assert block.split("```")[0].strip() in (EXAMPLE / "test_our_profiler.py").read_text()


@pytest.mark.parametrize("page", ["tutorial", "view", "allan", "batch"])
def test_every_command_prints_what_the_page_shows(page: str) -> None:
    found = subprocess.run(
        [sys.executable, ".ci/consoles.py", f"docs/{page}.md"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr
