"""A page in a browser: zooming draws other data, keys and touch work, the console stays empty."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from floatref.values.clock import StampedClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref.viewer import write_profile_page, write_recording_page
from floatref.viewer.page_file import PageOptions

pytestmark = pytest.mark.slow

INSIDE = """([k, from, to]) => {
    drawNow();
    const [x, ...rows] = panels[k].plot.data;
    const inside = (row) => [...row].filter((_, i) => x[i] > from && x[i] < to);
    const solid = rows.filter((_, i) => i % 4 === 0).map(inside);
    return solid.map((ys) => [ys.some((y) => typeof y === "number"), ys.every((y) => y === null)]);
}"""
"""Whether the solid line of every wheel path has a number there, and whether all of it is a gap.

A place without a bin, undefined, is no gap: the line goes on across it."""
DATA = "k => { drawNow(); return panels[k].plot.data.map((row) => [...row]); }"


def text(page: Any) -> str:
    return str(page.text_content("#place"))


def test_zoom_draws_finer_data_with_the_same_extremes(
    opened: Callable[..., Any], pages: Path, road: Callable[..., Profile]
) -> None:
    page = opened(pages / "runs.html")
    before = page.evaluate(DATA, 0)
    box = page.locator(".u-over").first.bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 50)
    page.mouse.down()
    page.mouse.move(box["x"] + 150, box["y"] + 60, steps=4)
    page.mouse.up()
    after = page.evaluate(DATA, 0)
    assert after != before
    assert after[0][0] > before[0][0]
    assert after[0][-1] < before[0][-1]
    assert "every one of the points" in text(page)
    assert page.text_content("h2") == "Elevation (mm)"
    # What is drawn at full zoom are the points of the profile.
    z = 1000.0 * road()["left"].elevation
    at, drawn = np.array(after[0]), np.array(after[1], dtype=np.float64)
    known = np.isfinite(drawn)
    index = np.rint(at[known] / 0.05).astype(int)
    np.testing.assert_allclose(drawn[known], z[index], rtol=1e-5, atol=1e-4)


def test_all_of_a_line_is_within_what_is_drawn(
    opened: Callable[..., Any], pages: Path, drive: Recording
) -> None:
    page = opened(pages / "drive.html")
    data = page.evaluate(DATA, 1)
    left = 1000.0 * drive.channel("height", "left").values
    drawn = np.array([y for y in data[1] if y is not None])
    assert (drawn.min(), drawn.max()) == pytest.approx((np.nanmin(left), np.nanmax(left)), rel=1e-6)
    # The missing second is a gap and shaded.
    at = np.array(data[0])
    inside = (at > 30.1) & (at < 30.9)
    assert all(y is None for y, is_in in zip(data[1], inside, strict=True) if is_in)
    ((begin, end),) = page.evaluate("panels[1].marks")
    assert (begin, end) == pytest.approx((30.0, 31.0), abs=0.1)


def test_keys_move_zoom_and_switch(opened: Callable[..., Any], pages: Path) -> None:
    page = opened(pages / "runs.html")
    whole = text(page)

    def press(key: str) -> str:
        page.keyboard.press(key)
        page.evaluate("drawNow()")
        return text(page)

    near = press("+")
    right = press("ArrowRight")
    assert len({whole, near, right}) == 3
    assert press("ArrowLeft") == near
    assert press("0") == whole
    assert " ft" in press("u")
    assert " s," in press("a")
    press("u")
    press("1")
    hidden = page.evaluate("panels[0].lines.map(isHidden)")
    assert hidden == [True, False, True, False]


def test_units_and_axis_change_picture_and_table(opened: Callable[..., Any], pages: Path) -> None:
    page = opened(pages / "runs.html")
    before = page.evaluate(DATA, 0)
    cell = "table tbody tr >> nth=0 >> td >> nth=2"
    metric = float(page.text_content(cell))
    page.select_option("select >> nth=1", "us")
    after = page.evaluate(DATA, 0)
    assert after[0][-1] == pytest.approx(before[0][-1] / 0.3048)
    peaks = [max(y for y in data[1] if y is not None) for data in (before, after)]
    assert peaks[1] == pytest.approx(peaks[0] / 25.4, rel=1e-6)
    assert float(page.text_content(cell)) == pytest.approx(63.36 * metric, abs=0.4)
    page.select_option("select >> nth=0", "time")
    # The profile is longer than the drive, which lasts 40 s.
    assert max(page.evaluate(DATA, 0)[0]) == pytest.approx(39.9, abs=0.3)


def test_over_time_no_line_crosses_what_is_not_valid(
    opened: Callable[..., Any], road: Callable[..., Profile], drive: Recording, tmp_path: Path
) -> None:
    """At a standstill the columns of the picture have no bin, and yet are a gap."""
    encoder = next(c for c in drive.channels if c.id.name == "distance")
    stopped = np.maximum(np.minimum(encoder.values, 220.0), encoder.values - 80.0)
    others = tuple(c for c in drive.channels if c is not encoder)
    held = replace(drive, channels=(replace(encoder, values=stopped), *others))
    write_profile_page(tmp_path / "stop.html", {"first": road()}, PageOptions(), held)
    page = opened(tmp_path / "stop.html")
    page.select_option("select >> nth=0", "time")
    times = encoder.clock.times(encoder.values.size) - encoder.span_s[0]
    # The profile is not valid from 200 to 240 m.
    begin_s, end_s = (float(times[np.searchsorted(stopped, at)]) for at in (201.0, 239.0))
    for part in (None, [begin_s - 1.0, end_s + 1.0], [begin_s - 5.0, end_s - 3.0]):
        if part is not None:
            page.evaluate("([from, to]) => showPart(from, to)", part)
        for panel in (0, 1):
            found = page.evaluate(INSIDE, [panel, begin_s, end_s])
            assert found == [[False, True]] * 2


def test_wheel_paths_runs_and_shift(opened: Callable[..., Any], pages: Path) -> None:
    page = opened(pages / "runs.html")
    page.get_by_label("right", exact=True).uncheck()
    data = page.evaluate(DATA, 0)
    assert all(y is None for y in data[5])
    assert any(y is not None for y in data[1])
    page.get_by_text("remove").click()
    assert page.evaluate("shown.shifts[1]") == pytest.approx(-0.4, abs=1e-6)
    page.evaluate("showPart(50, 52)")
    data = page.evaluate(DATA, 0)
    pairs = [
        (first, late)
        for first, late in zip(data[1], data[9], strict=True)
        if isinstance(first, float) and isinstance(late, float)
    ]
    heights = np.array(pairs)
    np.testing.assert_allclose(np.diff(heights[:, 0]), np.diff(heights[:, 1]), atol=1e-3)
    page.get_by_label("late", exact=True).uncheck()
    assert all(y is None for y in page.evaluate(DATA, 0)[9])


def test_a_run_65_m_away_is_drawn_over_the_reference(
    opened: Callable[..., Any], road: Callable[..., Profile], tmp_path: Path
) -> None:
    runs = {"first": road(), "late": replace(road(), start_m=65.0), "other": road(seed=8)}
    write_profile_page(tmp_path / "moved.html", runs, PageOptions())
    page = opened(tmp_path / "moved.html")
    choices = page.locator(".run").all_text_contents()
    assert "moved by -65.000 m" in choices[1]
    assert "place not sure: the best correlation" in choices[2]
    page.evaluate("showPart(50, 52)")
    data = page.evaluate(DATA, 0)
    pairs = [pair for pair in zip(data[1], data[9], strict=True) if None not in pair]
    assert len(pairs) > 20
    np.testing.assert_allclose(*np.array(pairs, dtype=np.float64).T, atol=1e-3)


def test_a_row_of_the_table_shows_its_place(opened: Callable[..., Any], pages: Path) -> None:
    page = opened(pages / "runs.html")
    page.get_by_role("button", name="100.00", exact=True).first.click()
    begin, end = page.evaluate("[shown.begin, shown.end]")
    assert begin < 100.0 < 200.0 < end < 220.0


def test_a_page_of_next_to_nothing_opens(opened: Callable[..., Any], tmp_path: Path) -> None:
    invalid = ProfileTrack.of("left", np.arange(300.0), np.zeros(300, np.bool_))
    missing = ProfileTrack.of("left", np.full(300, np.nan))
    short = ProfileTrack.of("left", [0.0, 0.1])
    for name, track in (("invalid", invalid), ("missing", missing), ("short", short)):
        path = tmp_path / f"{name}.html"
        write_profile_page(path, {name: Profile(0.25, (track,))}, PageOptions())
        page = opened(path)
        assert text(page).startswith("0.0")
        for key in "+-0u":
            page.keyboard.press(key)
        page.evaluate("drawNow()")
    lone = Recording((Channel.of("gnss_height", [1.0], StampedClock.of([6.0])),))
    write_recording_page(tmp_path / "lone.html", "lone", lone, PageOptions())
    assert "every one of the samples" in text(opened(tmp_path / "lone.html"))
