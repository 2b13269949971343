"""The tutorial prints what it shows."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]


def test_every_command_of_the_tutorial_prints_what_the_page_shows() -> None:
    found = subprocess.run(
        [sys.executable, ".ci/consoles.py", "docs/tutorial.md"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr
