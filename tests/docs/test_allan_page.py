"""The page on noise at rest: the settings that it names."""

import re
from pathlib import Path

from floatref.cli.allan.allan_report import SETTINGS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "allan.md").read_text(encoding="utf-8")


def test_the_page_names_every_setting_with_its_coefficient_and_channel() -> None:
    rows = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \| \$([NK])\$, .+ \| (.+) \|$", PAGE, re.M)
    symbols = {name: symbol for names, symbol, _ in rows for name in re.findall(r"`(\w+)`", names)}
    expected = {"white_noise": "N", "random_walk": "K"}
    assert symbols == {name: expected[term] for name, (_, term) in SETTINGS.items()}
