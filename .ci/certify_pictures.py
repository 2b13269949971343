"""Take the pictures of docs/certify.md: a worksheet with two bad runs, on paper and in a terminal.

    python .ci/certify_pictures.py

The data are those of `conformance sample certification`, processed by `floatref process`. Then the
encoder of run 4 counts 1.02 % too much, and the heights of run 8 are 3 % too large.
"""

import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from playwright.sync_api import Page
from terminal import MOVES, as_html, browser_page, environment, picture, run_in_terminal

from floatref import Profile, ProfileTrack, read_profile, write_profile

IMAGES = Path(__file__).parents[1] / "docs" / "images"
COLUMNS, LAST_SHOWN = 118, "Pairs of runs, wheel path left"
"""Of the terminal; and the table at whose end its picture ends."""
LONGER, HIGHER = 1.0102, 1.03
CERTIFY = "conformance certify --plan plan.toml --report report"


def make_runs(folder: Path) -> None:
    """Draw the sample, process its runs, and change two of them."""
    for command in ("conformance sample certification --out sample", *_processing()):
        words = ["bash", "-c", command]
        subprocess.run(words, cwd=folder, env=environment(folder / ".cache"), check=True)
    plan = (folder / "sample" / "plan.toml").read_text(encoding="utf-8")
    plan = plan.replace("sample, drawn with seed 0", "Van 7, laser 0815")
    for name in ("reference", "quiescent", "bounce"):
        plan = plan.replace(f'= "{name}"', f'= "sample/{name}"')
    (folder / "plan.toml").write_text(plan, encoding="utf-8")
    for number in range(1, 11):
        name = f"run-{number}"
        write_profile(
            _changed(read_profile(folder / "made" / name), number), folder / "runs" / name
        )


def _processing() -> Iterator[str]:
    yield "mkdir made runs"
    for number in range(1, 11):
        yield f"floatref process sample/runs/run-{number} --out made/run-{number} > /dev/null"


def _changed(run: Profile, number: int) -> Profile:
    if number == 4:
        return replace(run, interval_m=LONGER * run.interval_m, start_m=LONGER * run.start_m)
    if number == 8:
        return replace(run, tracks=tuple(map(_higher, run.tracks)))
    return run


def _higher(track: ProfileTrack) -> ProfileTrack:
    return ProfileTrack.of(track.name, HIGHER * track.elevation, track.valid, track.sigma)


def show_terminal(text: str) -> None:
    """Draw what the command printed, from the verdict to the end of the first table of pairs."""
    plain = MOVES.sub("", text).replace("\r\n", "\n")
    body, _, rest = plain[plain.index("FAIL: ") :].partition(LAST_SHOWN)
    table = rest.split("\n\n")[0]
    picture(as_html(f"{body}{LAST_SHOWN}{table}"), COLUMNS, IMAGES / "certify-terminal.png")


def show_page(page: Page) -> None:
    """Take the first sheet, the pictures of a wheel path, and the lag of the bad run."""
    criteria = page.locator("section[aria-labelledby=criteria]").bounding_box()
    assert criteria is not None
    first = {"x": 0, "y": 0, "width": 1100, "height": criteria["y"] + criteria["height"] + 10}
    page.screenshot(path=IMAGES / "certify-page.png", full_page=True, clip=first)
    figures = page.locator("figure")
    texts = [text.strip() for text in figures.all_text_contents()]
    left = [k for k, text in enumerate(texts) if "Wheel path left:" in text][:3]
    (lag,) = [k for k, text in enumerate(texts) if "Run run-4, wheel path right:" in text]
    for name, shown in (("certify-pictures", left), ("certify-lag", [lag])):
        boxes = [figures.nth(k).bounding_box() for k in shown]
        tops, ends = zip(*((b["y"], b["y"] + b["height"]) for b in boxes if b), strict=True)
        clip = {"x": 0, "y": min(tops) - 8, "width": 1100, "height": max(ends) - min(tops) + 16}
        page.screenshot(path=IMAGES / f"{name}.png", full_page=True, clip=clip)


def main() -> None:
    """Make the worksheet and take its pictures."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_runs(folder)
        show_terminal(run_in_terminal(CERTIFY, folder, COLUMNS))
        with browser_page(1100) as opened:
            show_page(opened((folder / "report" / "worksheet.html").as_uri()))


if __name__ == "__main__":
    main()
