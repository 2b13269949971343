"""`floatref view` and `floatref plot`: what they write, and what they refuse in one line."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.image import imread

from floatref.files import write_profile, write_profile_csv, write_recording
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording

Ran, Refused = Callable[..., Any], Callable[..., str]
STARTS = {b"\x89PNG": ".png", b"<?xm": ".svg", b"%PDF": ".pdf"}


def profile(valid: bool = True, count: int = 600) -> Profile:
    z = np.cumsum(np.random.default_rng(0).normal(0.0, 5e-4, count))
    return Profile(0.1, (ProfileTrack.of("left", z, np.full(count, valid)),), pipeline="test")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with a profile, one of no valid point, a table, and a recording."""
    write_profile(profile(), tmp_path / "p")
    write_profile(profile(valid=False), tmp_path / "invalid")
    write_profile_csv(profile(), tmp_path / "p.csv")
    clock = UniformClock.of(100.0)
    height = Channel.of("height", 0.3 + 0.01 * np.sin(np.arange(3000.0)), clock, "left")
    distance = Channel.of("distance", np.arange(3000.0) * 0.1, clock)
    write_recording(Recording((height, distance)), tmp_path / "run")
    return tmp_path


def written(folder: Path) -> set[str]:
    """Return the names in ``folder``."""
    return {path.name for path in folder.iterdir()}


@pytest.mark.slow
@pytest.mark.parametrize("source", ["p", "p.csv", "invalid", "run", "p/profile.json"])
def test_every_source_becomes_a_page_and_a_picture(folder: Path, ran: Ran, source: str) -> None:
    page = ran("view", folder / source, "-o", folder / "page.html")
    assert re.search(r"page\.html: \d+\.\d MB, every one of the (points|samples)", page.stdout)
    ran("plot", folder / source, "-o", folder / "picture.png")
    assert imread(folder / "picture.png").shape[1] > 700


@pytest.mark.slow
@pytest.mark.parametrize("suffix", STARTS.values())
def test_a_suffix_chooses_the_kind_of_picture(folder: Path, ran: Ran, suffix: str) -> None:
    out = folder / f"picture{suffix}"
    ran("plot", folder / "run", "-o", out, "--from", 3, "--to", 9, "--units", "us", "--title", "T")
    assert STARTS[out.read_bytes()[:4]] == suffix


def test_a_page_has_the_title_units_and_channels_that_were_asked_for(
    folder: Path, ran: Ran
) -> None:
    ask = ["--title", "A <road>", "--units", "us", "--channel", "height", "--from", 3, "--to", 4]
    ran("view", folder / "run", "-o", folder / "page.html", *ask)
    text = (folder / "page.html").read_text(encoding="utf-8")
    assert "<h1>A &lt;road&gt;</h1>" in text
    assert '"units": "us"' in text
    assert re.findall(r'"count": (\d+)', text)[0] == "101"
    assert '"title": "Distance"' not in text


BAD = [
    (["nothing"], "nothing: not found"),
    (["p", "--from", "70"], r"p: from 70: holds fewer than two points; .* from 0 to 59.9 m"),
    (["run", "--from", "40"], "run: from 40: holds no sample; the recording lasts 29.99 s"),
    (["p", "--from", "9", "--to", "3"], "from 9 to 3: ends before it begins"),
    (["p", "--from", "nan"], "from nan: not a number"),
    (["p", "--channel", "height"], "--channel height: a profile has no channels"),
    (["run", "--channel", "hight"], "run: channel hight: .*did you mean height"),
    (["text.txt"], "text.txt"),
    (["empty.csv"], "empty.csv"),
    (["p", "--map", "m.toml"], "m.toml: No such file"),
]
ONLY_VIEW = [
    (["p", "run"], "run: a recording among profiles; give it alone, or with --recording"),
    (["p", "p"], "p: given twice"),
    (["p", "--recording", "p"], "p"),
    (["p", "--segment", "-1"], r"segment_m is -1\.0; it must be a finite number above zero"),
    (["p", "--size", "0"], "size 0 MB; give 1 to 2000"),
]


@pytest.mark.parametrize(
    ("command", "arguments", "line"),
    [
        *(("view", *case) for case in [*BAD, *ONLY_VIEW]),
        *(("plot", *case) for case in BAD),
    ],
)
def test_bad_input_is_one_line_and_leaves_nothing(
    folder: Path,
    refused: Refused,
    monkeypatch: pytest.MonkeyPatch,
    command: str,
    arguments: list[str],
    line: str,
) -> None:
    (folder / "text.txt").write_text("no profile\n")
    (folder / "empty.csv").write_text("")
    monkeypatch.chdir(folder)
    before = written(folder)
    out = "out.html" if command == "view" else "out.png"
    assert re.search(line, refused(command, *arguments, "-o", out))
    assert written(folder) == before


@pytest.mark.parametrize(
    ("command", "out", "line"),
    [
        ("view", "page.txt", "not the name of a page; end it with .html or .htm"),
        ("plot", "picture.gif", "not the name of a drawing"),
        ("view", "old.html", "exists"),
        ("plot", "old.png", "exists"),
        ("view", "p/page.html", "is, or is inside, a source"),
        ("plot", "no/where.png", "its folder does not exist"),
    ],
)
def test_bad_targets_are_refused(
    folder: Path, refused: Refused, command: str, out: str, line: str
) -> None:
    for name in ("old.html", "old.png"):
        (folder / name).write_text("old")
    assert line in refused(command, folder / "p", "-o", folder / out)
    assert (folder / "old.html").read_text() == (folder / "old.png").read_text() == "old"


def test_an_interruption_leaves_the_old_page(
    folder: Path, invoke: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "page.html").write_text("old")

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("floatref.viewer.page_writer.PageWriter.close", interrupt)
    found = invoke("view", folder / "p", "-o", folder / "page.html", "--overwrite")
    assert found.exit_code != 0
    assert (folder / "page.html").read_text() == "old"
    assert not [name for name in written(folder) if name.startswith(".floatref")]
