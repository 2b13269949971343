"""A page on a phone: the figures that matter are seen first, and a finger moves the picture."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from floatref.values.profile import Profile
from floatref.viewer import write_profile_page
from floatref.viewer.page_file import PageOptions

pytestmark = pytest.mark.slow

PHONE = {
    "viewport": {"width": 390, "height": 844},
    "is_mobile": True,
    "has_touch": True,
    "device_scale_factor": 2,
}


@pytest.mark.parametrize("name", ["first", "northbound_right_lane_2026-11-26_run-10.parquet"])
def test_a_phone_shows_the_iri_and_its_share_without_a_movement(
    opened: Callable[..., Any], road: Callable[..., Profile], tmp_path: Path, name: str
) -> None:
    runs = {name: road(), "late": road(shift=-8)}
    write_profile_page(tmp_path / "runs.html", runs, PageOptions())
    page = opened(tmp_path / "runs.html", **PHONE)
    cells = page.locator("table tbody tr >> nth=0").locator("td")
    heads = page.locator("table thead th").all_text_contents()
    for k, title in ((1, "wheel path"), (2, "IRI of valid points (m/km)"), (3, "share")):
        assert heads[k].startswith(title)
        box = cells.nth(k).bounding_box()
        assert box["x"] >= 0.0
        assert box["x"] + box["width"] <= 390.0


def test_a_phone_shows_it_and_pans_by_touch(opened: Callable[..., Any], pages: Path) -> None:
    page = opened(pages / "drive.html", **PHONE)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    sizes = page.evaluate(
        "[...document.querySelectorAll('#moves button')].map(b => b.offsetHeight)"
    )
    assert min(sizes) >= 44
    page.evaluate("showPart(10, 20)")
    page.evaluate("drawNow()")
    touch = """(xs) => xs.forEach((x, k) => document.querySelector('#picture').dispatchEvent(
      new PointerEvent(k ? 'pointermove' : 'pointerdown',
        {pointerId: 1, pointerType: 'touch', clientX: x, clientY: 300, bubbles: true})))"""
    page.evaluate(touch, [200, 150])
    begin, end = page.evaluate("[shown.begin, shown.end]")
    assert begin > 10.5
    assert end - begin == pytest.approx(10.0)
    assert page.locator("#map canvas").is_visible()
