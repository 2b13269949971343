"""Line plots: sound, small, and true to the lines that are drawn."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from floatref_conformance.render.scales import Scale, decimate, scale_of, ticks
from floatref_conformance.render.svg import (
    MOST_POINTS,
    Figure,
    Line,
    Mark,
    Panel,
    Shade,
    draw_figure,
)

NUMBERS = st.floats(-1e308, 1e308)
VALUES = arrays(
    np.float64, st.integers(1, 3000), elements=st.one_of(st.just(np.nan), st.floats(-1e6, 1e6))
)
FEW = settings(max_examples=30, deadline=None)


def figure(*lines, **changes):
    panels = (Panel("elevation", "mm", lines),)
    about = {"along": "distance in m", "start": 0.0, "end": 100.0, **changes}
    return Figure("plot", "A title", "A description", panels, **about)


def line(y, label="result"):
    return Line(label, np.linspace(0.0, 100.0, len(y)), np.asarray(y, dtype=float), "result")


def path(svg, style="line result"):
    found = [e.get("d") for e in ElementTree.fromstring(svg).iter("path")]
    kinds = [e.get("class") for e in ElementTree.fromstring(svg).iter("path")]
    return [d for d, kind in zip(found, kinds, strict=True) if kind == style]


@FEW
@given(VALUES, st.integers(10, 200).map(lambda n: 2 * n))
def test_few_points_keep_the_envelope_and_every_gap(values, most):
    strokes = decimate(values, most)
    kept = np.concatenate([*strokes, np.empty(0, dtype=np.int64)])
    finite = values[np.isfinite(values)]
    assert kept.size <= max(most, 0)
    assert (np.diff(kept) > 0).all()
    assert kept.size == 0 or np.ptp(values[kept]) == np.ptp(finite)
    for stroke in strokes:
        assert np.isfinite(values[stroke[0] : stroke[-1] + 1]).all()


def test_a_short_line_is_drawn_with_all_its_points():
    (stroke,) = decimate(np.arange(50.0), 100)
    assert stroke.tolist() == list(range(50))


@FEW
@given(NUMBERS, st.floats(1e-9, 1e9), st.integers(2, 12))
@example(6065119850976582.0, 2.0, 10)
def test_ticks_are_few_round_and_inside(low, spread, most):
    high = low + spread
    found = ticks(low, high, most)
    assert len(found) <= most + 1
    if abs(low) < 1e3 and spread > 1e-6:
        step = np.diff(found)
        assert (np.asarray(found) >= low - 1e-6 * spread).all()
        assert (np.asarray(found) <= high + 1e-6 * spread).all()
        for s in step:
            mantissa = float(f"{s:.6e}".partition("e")[0])
            assert mantissa in (1.0, 2.0, 5.0)


@FEW
@given(arrays(np.float64, st.integers(1, 20), elements=NUMBERS), st.booleans())
def test_a_scale_shows_all_its_values(values, from_zero):
    scale = scale_of([values], 0.0, 100.0, from_zero)
    shown = np.clip(values, -1e300, 1e300)
    assert all(-1e-6 <= scale(value) <= 100.0 + 1e-6 for value in shown)
    assert not from_zero or scale.low <= 0.0


def test_a_scale_without_values_is_that_from_0_to_1():
    assert scale_of([np.array([np.nan])], 0.0, 1.0) == Scale(0.0, 1.0, 0.0, 1.0)


@pytest.mark.slow
@FEW
@given(VALUES)
def test_a_plot_is_sound_small_and_the_same_every_time(values):
    svg = draw_figure(figure(line(values), line(-values, "truth")))
    root = ElementTree.fromstring(svg)
    assert svg == draw_figure(figure(line(values), line(-values, "truth")))
    assert len(svg) < 2 * MOST_POINTS * 16 + 5000
    numbers = re.findall(r"-?\d+\.?\d*", " ".join(path(svg)))
    assert all(0.0 <= float(n) <= float(root.get("viewBox").split()[2]) for n in numbers)


def test_a_missing_value_lifts_the_pen_and_a_lone_one_is_a_dot():
    (d,) = path(draw_figure(figure(line([1, 2, np.nan, 3, np.nan, 4, 5]))))
    assert d.count("M") == 3
    assert d.count("h.1") == 1


def test_points_beyond_the_axis_are_not_drawn():
    svg = draw_figure(figure(line(np.arange(11.0)), end=50.0))
    (d,) = path(svg)
    assert len(re.findall(r"\d+\.?\d* \d+\.?\d*", d)) == 6


def test_an_axis_that_holds_some_values_leaves_out_what_lies_beyond():
    values = np.array([0.0, 1.0, 1000.0, 1.0, 0.0])
    panel = Panel("elevation", "mm", (line(values),), held=values[:2])
    (d,) = path(draw_figure(Figure("plot", "", "", (panel,), "m", 0.0, 100.0)))
    assert d.count("M") == 2
    (whole,) = path(draw_figure(figure(line(values))))
    assert whole.count("M") == 1


def test_a_shade_lies_where_it_says_and_a_mark_too():
    shade = Shade("flagged", ((25.0, 50.0),), "flagged")
    svg = draw_figure(figure(line([0, 1]), shades=(shade,), marks=(Mark(50.0, "stop"),)))
    flagged = [d for d in path(svg, "flagged") if "V" in d]
    left, width = (float(n) for n in re.match(r"M(\S+) \S+h([\d.]+)", flagged[0]).groups())
    (mark,) = path(svg, "mark")
    at = float(re.match(r"M(\S+) ", mark).group(1))
    assert left + width == pytest.approx(at, abs=0.1)
    start, end = (float(n) for n in re.match(r"M(\S+) .*L(\S+) ", path(svg)[0]).groups())
    assert left == pytest.approx(start + (end - start) / 4, abs=0.1)


def test_a_mark_outside_the_axis_is_left_out():
    assert path(draw_figure(figure(line([0, 1]), marks=(Mark(101.0, "stop"),))), "mark") == []


def test_hostile_words_are_text(hostile):
    shade = Shade(hostile, ((0.0, 1.0),), "flagged")
    changes = {"along": hostile, "shades": (shade,), "marks": (Mark(1.0, hostile),)}
    panel = Panel(hostile, hostile, (line([0, 1], hostile), line([1, 0])))
    svg = draw_figure(Figure("plot", hostile, hostile, (panel,), start=0.0, end=100.0, **changes))
    root = ElementTree.fromstring(svg)
    assert "script" not in {element.tag for element in root.iter()}
    assert all("<script>" in text.text for text in root.iter("title"))


def test_a_plot_is_named_and_described_for_those_who_do_not_see_it():
    root = ElementTree.fromstring(draw_figure(figure(line([0, 1]))))
    names = {element.get("id"): element.text for element in root.iter()}
    assert [names[id_] for id_ in root.get("aria-labelledby").split()] == [
        "A title",
        "A description",
    ]
