"""The drawing of normalized innovations: a row for each kind, along the run and as a histogram."""

from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.plots import draw_innovations
from floatref.plots.figure import COLOURS
from floatref.plots.innovation_picture import TOGETHER, _rms
from floatref.values.innovations import Innovations


def kept(count: int = 900, size: float = 1.0, begin: float = 0.0, seed: int = 0) -> Innovations:
    found = Innovations()
    z = size * np.random.default_rng(seed).standard_normal(count)
    found.add(begin + 0.05 * np.arange(count), z)
    return found


@pytest.mark.slow
def test_every_kind_has_its_row_with_the_figures_of_every_track(tmp_path: Path) -> None:
    found = {
        "left": {"gnss_height": kept(), "reflection": kept(200, begin=20.0)},
        "right": {"gnss_height": kept(size=3.0), "never": Innovations(left_out=4)},
    }
    draw_innovations(found, tmp_path / "a.svg", "a heading")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert text.count('<g id="axes_') == 4
    for part in ("a heading", "gnss_height", "reflection", "Time (s)", "left: mean NIS ", "of 900"):
        assert part in text
    assert "never" not in text


@pytest.mark.slow
def test_each_track_has_its_colour_over_the_whole_run(tmp_path: Path, colour_share) -> None:
    found = {"left": {"height": kept()}, "right": {"height": kept(size=2.0, seed=1)}}
    draw_innovations(found, tmp_path / "a.png", "")
    for colour in COLOURS[:2]:
        assert colour_share(tmp_path / "a.png", colour) > 0.5
    assert colour_share(tmp_path / "a.png", COLOURS[2]) == 0.0


@pytest.mark.slow
def test_one_innovation_and_some_far_beyond_are_drawn(tmp_path: Path) -> None:
    found = {"left": {"one": kept(1), "far": kept(300, size=40.0)}}
    draw_innovations(found, tmp_path / "a.png", "")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_the_line_is_the_root_mean_square_and_has_a_gap_at_a_stop() -> None:
    found = kept(20 * TOGETHER, size=3.0)
    found.times_s[10 * TOGETHER + 5 :] += 100.0
    times_s, rms = _rms(found)
    assert rms.size == 20
    assert np.flatnonzero(np.isnan(rms)).tolist() == [10]
    assert np.nanmean(rms**2) == pytest.approx(9.0, rel=0.2)
    assert (np.diff(times_s) > 0.0).all()


def test_nothing_to_draw_is_one_line(tmp_path: Path) -> None:
    for found in ({}, {"left": {}}, {"left": {"height": Innovations(left_out=2)}}):
        with pytest.raises(InputError, match="no innovations to draw"):
            draw_innovations(found, tmp_path / "a.png", "")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "text"), [("nowhere/a.png", "its folder does not exist"), ("a.txt", "not the name")]
)
def test_an_unwritable_target_is_one_line(tmp_path: Path, name: str, text: str) -> None:
    with pytest.raises(InputError, match=text):
        draw_innovations({"left": {"height": kept()}}, tmp_path / name, "")
    assert not list(tmp_path.iterdir())
