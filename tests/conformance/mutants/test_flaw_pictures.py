"""Every flaw with a profile has its picture, and a picture shows what its mutant delivers."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest

from floatref_conformance.resemblance.catalogue import read_vectors

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "docs" / "images" / "flaws"
MOST_BYTES, MOST_OF_ALL = 15_000, 1_500_000
PIXELS = 0.1
"""By how much a line may be elsewhere: numbers in a picture are rounded to tenths of a pixel."""
FINE = 8
"""Places between two points of a run at which its line is compared with a picture."""


@pytest.fixture
def pictures(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    return importlib.import_module("flaw_pictures")


def read_line(svg, kind):
    """Return all points of the lines of ``kind``, in pixels, shape (n, 2)."""
    found = re.findall(rf'class="{kind}" points="([^"]*)"', svg)
    return np.array([[float(v) for v in p.split(",")] for line in found for p in line.split()])


def distance_off(points, x, y):
    """Return how far ``points``, shape (n, 2), are from the line through ``x`` and ``y``."""
    along = np.arange(x.size, dtype=float)
    fine = np.arange(0.0, x.size - 1 + 1e-9, 1.0 / FINE)
    line = np.column_stack([np.interp(fine, along, x), np.interp(fine, along, y)])
    return np.array([np.hypot(*(line - point).T).min() for point in points])


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
def test_every_picture_shows_what_its_mutant_delivers_now(pictures):
    """The points of its lines, against the lines of a run of the mutant."""
    for flaw in (flaw for flaw in read_vectors().flaws if not flaw.needs):
        svg = (FOLDER / f"{flaw.mutant}.svg").read_text(encoding="utf-8")
        x0, x1, low, high = map(float, re.search(r'data-span="(.*?)"', svg)[1].split())
        now = pictures.draw_mutant(flaw)
        assert re.search(r'data-probe="(.*?)"', svg)[1] == now.probe
        across = (pictures.WIDTH - 2 * pictures.MARGIN) / (x1 - x0)
        down = (pictures.HEIGHT - pictures.MARGIN - pictures.BOTTOM) / (high - low)
        for kind, z in (("truth", now.truth), ("profile", now.found)):
            known = np.isfinite(z)
            x = pictures.MARGIN + (now.distance_m[known] - x0) * across
            y = pictures.MARGIN + (high - z[known]) * down
            assert distance_off(read_line(svg, kind), x, y).max() <= PIXELS, (flaw.mutant, kind)
