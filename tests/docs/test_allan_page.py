"""The page on noise at rest: what its commands print, and the settings that it names."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from floatref.cli.allan.allan_report import SETTINGS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "allan.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_every_command_prints_what_the_page_shows() -> None:
    found = subprocess.run(
        [sys.executable, ".ci/consoles.py", "docs/allan.md"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_page_names_every_setting_with_its_coefficient_and_channel() -> None:
    rows = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \| \$([NK])\$, .+ \| (.+) \|$", PAGE, re.M)
    symbols = {name: symbol for names, symbol, _ in rows for name in re.findall(r"`(\w+)`", names)}
    expected = {"white_noise": "N", "random_walk": "K"}
    assert symbols == {name: expected[term] for name, (_, term) in SETTINGS.items()}
