"""The pages on profile formats: the table has those there are, the example is what is written."""

import re
from pathlib import Path

import numpy as np

from floatref import Profile, ProfileTrack
from floatref.engine.plugins import plugins
from floatref_adapters.formats.erd.erd_header import parse_header
from floatref_adapters.formats.erd.erd_profile import Erd

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "profile-formats.md").read_text(encoding="utf-8")
(EXAMPLE,) = re.findall(
    r"^```text\n(ERD.*?)^```$", (DOCS / "erd.md").read_text(encoding="utf-8"), re.M | re.S
)


def test_the_table_has_every_format_with_its_suffix() -> None:
    table = [
        [cell.strip(" `") for cell in line.split("|")[2:-1]]
        for line in PAGE.splitlines()
        if line.startswith(("| | `", "| suffix |"))
    ]
    known = plugins().profile_formats().values()
    assert table == [[f.name for f in known], [f.suffix or "no suffix" for f in known]]


def test_the_example_is_what_is_written(tmp_path: Path) -> None:
    shown = EXAMPLE.splitlines()
    count = int(shown[1].split(",")[1])
    left, right = np.zeros(count), np.zeros(count)
    left[:2], right[:2] = (-0.0010431, -0.0010512), (-0.0008210, -0.0008196)
    tracks = (ProfileTrack.of("left", left, np.arange(count) > 0), ProfileTrack.of("right", right))
    path = tmp_path / "run.erd"
    Erd().write(Profile(0.00508, tracks, pipeline="temporal-basic"), path)
    written = path.read_text("ascii").splitlines()
    assert [line.rstrip() for line in written[: len(shown)]] == shown


def test_the_example_is_read() -> None:
    header = parse_header(EXAMPLE.encode())
    assert [channel.short for channel in header.channels] == ["LElev", "LValid", "RElev"]
    assert (header.step, header.start, header.key) == (0.00508, 0.0, 5)
