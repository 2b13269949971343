"""The pictures of a worksheet show every run where it lies, and tell without colour what is bad."""

import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.judging.contents import (
    Cause,
    RunSheet,
    RunTrack,
    SectionSheet,
    StationarySheet,
)
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.worksheet.figures import heat_map
from floatref_conformance.certify.worksheet.pictures import (
    CLOSE_M,
    at_rest,
    close_up,
    iri_by_run,
    lag_picture,
    overlay,
    roughest_m,
)
from floatref_conformance.render.svg import LEFT, RIGHT, TOP, WIDTH

LIMITS = CertificationLimits()
CAUSE = Cause("noise", "noise", 0.5)


def parts(svg, tag, style):
    return [e for e in ElementTree.fromstring(svg).iter(tag) if style in e.get("class", "").split()]


def points(path):
    return [tuple(map(float, at)) for at in re.findall(r"(-?[\d.]+) (-?[\d.]+)", path.get("d"))]


def drawn(svg, style):
    """Return the points of every path of ``style`` that does not belong to the legend."""
    found = [points(path) for path in parts(svg, "path", style)]
    return [path for path in found if path[0][1] > TOP]


@pytest.fixture
def section(section_of, run_of):
    """Return a function that makes a section of good runs and of those that do not agree."""
    make, numbers = run_of

    def made(good, bad):
        runs = [make(n, [numbers("left")]) for n in range(good)]
        runs += [
            make(good + n, [numbers("left", iri_m_per_km=2.0, causes=[CAUSE])]) for n in range(bad)
        ]
        return section_of(runs, tracks=("left",))

    return made


def test_every_run_has_its_line_and_bad_ones_another_stroke(section):
    svg = overlay(section(3, 2), "left", LIMITS, "x")
    counts = {s: len(parts(svg, "path", s)) for s in ("truth", "run", "failing-1", "failing-2")}
    # A panel of elevation, one of roughness, and the legend.
    assert counts == {"truth": 3, "run": 2 * 3 + 1, "failing-1": 3, "failing-2": 3}
    assert "run-3 (does not agree)" in svg


def test_many_bad_runs_share_a_name_in_the_legend(section):
    svg = overlay(section(1, 5), "left", LIMITS, "x")
    assert svg.count("runs that do not agree") == 1
    assert len(parts(svg, "path", "failing-1")) == 2 * 5 + 1


def test_a_run_without_the_wheel_path_or_without_a_profile_has_no_line(section, section_of, run_of):
    make, numbers = run_of
    runs = [
        make(1, [numbers("right")]),
        replace(make(2, [numbers("left")]), tracks=(), profile=None),
    ]
    svg = overlay(section_of(runs, tracks=("left",)), "left", LIMITS, "x")
    assert not parts(svg, "path", "run")
    assert len(parts(svg, "path", "truth")) == 2


@settings(max_examples=20, deadline=None)
@given(st.floats(20.0, 120.0))
def test_the_roughest_stretch_is_where_the_road_is_bad(at):
    x = np.arange(3201) * 0.05
    bad = np.where((x > at) & (x < at + CLOSE_M), 0.01 * np.sin(x * 2.6), 0.0)
    reference = Profile(0.05, (ProfileTrack.of("left", bad),), 1000.0)
    assert abs(roughest_m(reference, "left") - 1000.0 - at) < CLOSE_M / 2


def test_a_section_shorter_than_the_close_up_is_shown_from_its_start(section_of, run_of):
    make, numbers = run_of
    made = section_of([make(1, [numbers("left")])], tracks=("left",))
    short = Profile(0.05, (ProfileTrack.of("left", np.zeros(100)),), 100.0)
    assert roughest_m(short, "left") == 100.0
    assert "<svg" in close_up(made, "left", LIMITS, "x")


def test_a_close_up_shows_every_point_of_it(section):
    svg = close_up(section(1, 0), "left", LIMITS, "x")
    (reference,), (run,) = drawn(svg, "truth"), drawn(svg, "run")
    points_of_15_m = CLOSE_M / 0.05 + 1
    assert len(reference) >= points_of_15_m - 1
    assert len(run) >= points_of_15_m - 1


def test_dots_lie_above_their_run_in_the_order_of_their_iri(section):
    svg = iri_by_run(section(2, 1), LIMITS, "x")
    dots, squares = ([at for path in drawn(svg, s) for at in path] for s in ("dot", "square"))
    across = [LEFT + (n - 0.5) * (WIDTH - LEFT - RIGHT) / 3 for n in (1, 2, 3)]
    assert [x for x, _ in (*dots, *squares)] == pytest.approx(across, abs=0.1)
    assert squares[0][1] < min(y for _, y in dots)


def test_runs_are_numbered_by_whole_numbers(section):
    svg = iri_by_run(section(3, 0), LIMITS, "x")
    labels = re.search(r'class="numbers along">(.*?)</g>', svg)[1]
    assert re.findall(r">([^<]+)</text>", labels) == ["1", "2", "3"]


@settings(max_examples=30, deadline=None)
@given(st.integers(2, 40), st.integers(0, 1000))
def test_every_pair_has_its_cell_inside_the_picture(runs, seed):
    values = np.random.default_rng(seed).uniform(0.8, 1.0, (runs, runs))
    values[np.tril_indices(runs)] = np.nan
    svg = heat_map("x", "pairs", values, 0.92)
    low, high = ([e for e in parts(svg, "rect", s) if e.get("y") != "7"] for s in ("low", "high"))
    assert len(low) == (values < 0.92).sum()
    assert len(low) + len(high) == runs * (runs - 1) // 2
    assert all(float(e.get("x")) + float(e.get("width")) <= WIDTH for e in (*low, *high))
    assert all(0.0 <= float(e.get("fill-opacity")) <= 0.5 for e in (*low, *high))


def test_numbers_stand_in_the_cells_while_there_is_room():
    values = np.full((3, 3), np.nan)
    values[0, 1:], values[1, 2] = (0.987, 1.0), -0.04
    svg = heat_map("x", "pairs", values, 0.92)
    labels = {e.text: e.get("class") for e in parts(svg, "text", "inside")}
    assert labels == {".987": "inside high", "1.000": "inside high", "−.040": "inside low"}
    assert not parts(heat_map("x", "pairs", np.full((60, 60), 0.95), 0.92), "text", "inside")


def test_what_counts_of_a_stationary_test_is_shaded():
    z = 1e-5 * np.sin(np.arange(2001) / 9.0)
    profile = Profile(0.1, (ProfileTrack.of("left", z), ProfileTrack.of("right", 2 * z)))
    sheet = StationarySheet("bounce", "x", 50.0, 150.0, {}, (), (), profile)
    svg = at_rest(sheet, "x")
    shade, _ = parts(svg, "path", "scored")
    left, wide = re.match(r"M([\d.]+) [\d.]+h([\d.]+)", shade.get("d")).groups()
    width = WIDTH - LEFT - RIGHT
    assert float(left) == pytest.approx(LEFT + width / 4, abs=0.1)
    assert float(wide) == pytest.approx(width / 2, abs=0.1)
    assert at_rest(StationarySheet("bounce", "x", 0.0, 0.0, {}, (), ()), "x") == ""


@pytest.mark.parametrize("percent", [-1.0, -0.4, 0.4, 1.0])
def test_the_lag_of_a_run_grows_by_its_error_of_distance(percent):
    x = np.arange(3201) * 0.05
    steps = np.random.default_rng(4).normal(0.0, 1e-3, x.size)
    road = np.cumsum(steps - steps.mean())
    longer = np.interp(x / (1.0 + percent / 100.0), x, road)
    tracks = (RunTrack("left", 0.4, 0.0, 1.5, 0, 0.9, percent, 0.01, 0, 0, 0),)
    reference, found = (Profile(0.05, (ProfileTrack.of("left", z),), 100.0) for z in (road, longer))
    run = RunSheet("run-3", "x", (), tracks, "", found)
    section = SectionSheet("A", "x", 100.0, 260.0, {"left": 1.5}, (run,), {}, (), reference)
    svg = lag_picture(section, run, "left", "x")
    assert f"{percent:+.2f} %".replace("-", "−") in svg
    (line,), (dots,) = drawn(svg, "truth"), drawn(svg, "dot")
    assert len(dots) >= 10
    (x0, y0), (x1, y1) = line
    for at, y in dots:
        assert y == pytest.approx(y0 + (at - x0) * (y1 - y0) / (x1 - x0), abs=3.0)


def test_a_run_without_a_shape_has_no_picture_of_its_lag(section_of, run_of):
    make, numbers = run_of
    level = Profile(0.05, (ProfileTrack.of("left", np.zeros(3201)),), 100.0)
    run = make(1, [numbers("left", distance=1.0)])
    made = section_of([replace(run, profile=level)], tracks=("left",))
    assert lag_picture(made, made.runs[0], "left", "x") == ""
