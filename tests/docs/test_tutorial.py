"""The tutorial and other pages of commands print what they show."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("page", ["tutorial", "allan", "batch"])
def test_every_command_prints_what_the_page_shows(page: str) -> None:
    found = subprocess.run(
        [sys.executable, ".ci/consoles.py", f"docs/{page}.md"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr
