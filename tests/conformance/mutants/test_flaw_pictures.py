"""Every flaw with a profile has its picture, and a picture shows what its mutant delivers."""

import importlib
import random
import re
from pathlib import Path

import numpy as np
import pytest

from floatref_conformance.resemblance.catalogue import read_vectors

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "docs" / "images" / "flaws"
MOST_BYTES, MOST_OF_ALL = 15_000, 1_500_000
PIXELS = 1.5
"""By how much a line may be elsewhere, in pixels."""


@pytest.fixture
def pictures(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    return importlib.import_module("flaw_pictures")


def read_line(svg, kind):
    """Return all points of the lines of ``kind``, in pixels, shape (n, 2)."""
    found = re.findall(rf'class="{kind}" points="([^"]*)"', svg)
    return np.array([[float(v) for v in p.split(",")] for line in found for p in line.split()])


def test_every_flaw_with_a_profile_has_a_small_picture_on_the_page():
    drawn = {path.stem: path.stat().st_size for path in FOLDER.glob("*.svg")}
    assert set(drawn) == {flaw.mutant for flaw in read_vectors().flaws}
    assert max(drawn.values()) <= MOST_BYTES
    assert sum(drawn.values()) <= MOST_OF_ALL
    page = (ROOT / "docs" / "flaws.md").read_text(encoding="utf-8")
    assert set(re.findall(r"\(images/flaws/(.*?)\.svg\)", page)) == set(drawn)


def test_every_picture_has_both_lines_within_its_frame(pictures):
    for path in FOLDER.glob("*.svg"):
        svg = path.read_text(encoding="utf-8")
        assert f"mutant:{path.stem} " in svg
        for kind in ("truth", "profile"):
            points = read_line(svg, kind)
            assert points.size, path.stem
            assert points.min() >= 0.0, path.stem
            assert (points.max(axis=0) <= (pictures.WIDTH, pictures.HEIGHT)).all(), path.stem


@pytest.mark.slow
def test_pictures_of_drawn_flaws_show_what_their_mutants_deliver_now(pictures):
    """Places and heights of the lines, back in m, against a run of the mutant."""
    nominal = [flaw for flaw in read_vectors().flaws if not flaw.needs]
    for flaw in random.sample(nominal, 3):
        svg = (FOLDER / f"{flaw.mutant}.svg").read_text(encoding="utf-8")
        x0, x1, low, high = map(float, re.search(r'data-span="(.*?)"', svg)[1].split())
        now = pictures.draw_mutant(flaw)
        assert re.search(r'data-probe="(.*?)"', svg)[1] == now.probe
        across = (pictures.WIDTH - 2 * pictures.MARGIN) / (x1 - x0)
        down = (pictures.HEIGHT - pictures.MARGIN - pictures.BOTTOM) / (high - low)
        for kind, z in (("truth", now.truth), ("profile", now.found)):
            x, y = read_line(svg, kind).T
            places = x0 + (x - pictures.MARGIN) / across
            heights = high - (y - pictures.MARGIN) / down
            known = np.isfinite(z)
            expected = np.interp(places, now.distance_m[known], z[known])
            # A steep line is as far off as its place is.
            steep = np.abs(np.gradient(expected)) + PIXELS / down
            assert (np.abs(heights - expected) <= steep).all(), (flaw.mutant, kind)
