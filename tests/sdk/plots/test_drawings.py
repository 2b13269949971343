"""Drawings: complete files with the right content, or one clear error and no file."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from floatref.errors import InputError
from floatref.plots import draw_comparison, draw_profile
from floatref.plots.figure import COLOURS, SHADE
from floatref.values.profile import Profile, ProfileTrack

INTERVAL = 0.05


def road(seed: int, count: int = 4000) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 4e-4, count))


def profile(*names: str, invalid: slice = slice(0, 0), start: float = 100.0) -> Profile:
    tracks = []
    for seed, name in enumerate(names):
        z = road(seed)
        valid = np.ones(z.size, dtype=bool)
        valid[invalid] = False
        tracks.append(ProfileTrack.of(name, z, valid))
    return Profile(INTERVAL, tuple(tracks), start_m=start, pipeline="temporal-basic")


@pytest.mark.slow
def test_every_wheel_path_is_drawn_in_its_colour(tmp_path: Path, colour_share) -> None:
    draw_profile(profile("left", "right"), tmp_path / "p.png")
    for colour in COLOURS[:2]:
        assert colour_share(tmp_path / "p.png", colour) > 0.8
    for colour in (COLOURS[2], SHADE):
        assert colour_share(tmp_path / "p.png", colour) == 0.0
    assert [entry.name for entry in tmp_path.iterdir()] == ["p.png"]


@pytest.mark.slow
def test_shaded_width_is_that_of_the_invalid_stretch(tmp_path: Path, colour_share) -> None:
    shares = []
    for end in (1000, 3000):
        target = tmp_path / f"{end}.png"
        draw_profile(profile("left", invalid=slice(0, end)), target)
        shares.append(colour_share(target, SHADE))
    assert np.diff(shares) == pytest.approx(0.46, abs=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("speeds", [np.zeros(0), np.full(3, np.nan)])
def test_without_any_speed_there_is_no_panel(tmp_path: Path, speeds: np.ndarray) -> None:
    run = profile("left")
    draw_profile(run, tmp_path / "without.png")
    draw_profile(run, tmp_path / "none.png", (np.arange(speeds.size, dtype=float), speeds))
    assert (tmp_path / "none.png").read_bytes() == (tmp_path / "without.png").read_bytes()


def test_some_missing_speeds_leave_the_panel(tmp_path: Path) -> None:
    run = profile("left")
    draw_profile(run, tmp_path / "s.svg", (np.arange(3.0), np.array([1.0, np.nan, 2.0])))
    assert (tmp_path / "s.svg").read_text(encoding="utf-8").count('<g id="axes_') == 3


@pytest.mark.slow
@pytest.mark.parametrize("name", ["a$x^$", "$", "_left", "__", "左", "\\frac"])
def test_every_name_is_drawn_as_it_is_written(tmp_path: Path, name: str) -> None:
    run = profile(name, "right")
    draw_profile(run, tmp_path / "p.svg")
    draw_comparison(run, run, tmp_path / "c.svg")
    whole = (tmp_path / "p.svg").read_text(encoding="utf-8")
    both = (tmp_path / "c.svg").read_text(encoding="utf-8")
    assert f"<!-- {name.strip()} -->" in whole.replace("<!--  ", "<!-- ")
    assert f"{name}: IRI" in whole
    assert f"{name}: agreement" in both


def test_an_elevation_that_no_road_has_is_refused(tmp_path: Path) -> None:
    z = np.tile([1.7e308, -1.7e308], 500)
    run = Profile(INTERVAL, (ProfileTrack.of("left", z),))
    with pytest.raises(InputError, match=r"elevation of point 0 is 1.7e\+308 m"):
        draw_profile(run, tmp_path / "p.png")


@pytest.mark.slow
def test_speed_adds_a_panel(tmp_path: Path) -> None:
    run = profile("left")
    draw_profile(run, tmp_path / "without.png")
    draw_profile(run, tmp_path / "with.png", (run.distance_m, np.full(4000, 20.0)))
    heights = [imread(tmp_path / f"{name}.png").shape[0] for name in ("without", "with")]
    assert heights[1] > heights[0] + 100


@pytest.mark.slow
def test_comparison_has_a_column_for_each_wheel_path(tmp_path: Path, colour_share) -> None:
    run = profile("left", "right")
    draw_comparison(profile("left"), run, tmp_path / "one.png")
    draw_comparison(run, run, tmp_path / "two.svg")
    assert colour_share(tmp_path / "one.png", COLOURS[0]) > 0.5
    assert (tmp_path / "two.svg").read_text(encoding="utf-8").count('<g id="axes_') == 6


@pytest.mark.slow
def test_gaps_and_short_profiles_are_drawn_all_the_same(tmp_path: Path) -> None:
    z = road(1)
    z[:100] = z[2000:2500] = np.nan
    gappy = Profile(INTERVAL, (ProfileTrack.of("left", z),), start_m=100.0)
    draw_profile(gappy, tmp_path / "gaps.png")
    draw_comparison(profile("left"), gappy, tmp_path / "comparison.png")
    short = Profile(INTERVAL, (ProfileTrack.of("left", z[100:150]),))
    draw_comparison(short, short, tmp_path / "short.png")
    assert len(list(tmp_path.iterdir())) == 3


def test_old_drawing_is_replaced(tmp_path: Path) -> None:
    target = tmp_path / "p.png"
    target.write_bytes(b"old")
    draw_profile(profile("left"), target)
    assert target.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("nowhere/p.png", "its folder does not exist"),
        ("p.json", "not the name of a drawing; end it with .png"),
        ("folder.png", "is not a file"),
    ],
)
def test_unwritable_target_is_one_line_and_no_file(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / "folder.png").mkdir()
    before = sorted(tmp_path.rglob("*"))
    for draw in (
        lambda: draw_profile(profile("left"), tmp_path / name),
        lambda: draw_comparison(profile("left"), profile("left"), tmp_path / name),
    ):
        with pytest.raises(InputError, match=text):
            draw()
    assert sorted(tmp_path.rglob("*")) == before


def test_missing_matplotlib_says_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(InputError, match=r"pip install -e \"\.\[plot\]\""):
        draw_profile(profile("left"), tmp_path / "p.png")


def test_wheel_path_missing_in_the_profile_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="track right: missing"):
        draw_comparison(profile("left", "right"), profile("left"), tmp_path / "p.png")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_importing_loads_no_matplotlib_and_drawing_no_pyplot(tmp_path: Path) -> None:
    code = (
        "import sys, numpy as np, floatref.plots as plots\n"
        "from floatref.values.profile import Profile, ProfileTrack\n"
        "assert not any(name.startswith('matplotlib') for name in sys.modules)\n"
        "z = np.zeros(500)\n"
        "plots.draw_profile(Profile(0.05, (ProfileTrack.of('main', z),)), sys.argv[1])\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code, str(tmp_path / "p.png")], check=True)
    assert (tmp_path / "p.png").exists()


@pytest.mark.slow
def test_a_placement_is_written_above_the_comparison(tmp_path: Path) -> None:
    run = profile("left")
    for name, placement_m in (("placed", 65.0), ("earlier", -65.0), ("right", 0.0), ("none", None)):
        draw_comparison(run, run, tmp_path / f"{name}.svg", placement_m=placement_m)
    texts = {path.stem: path.read_text(encoding="utf-8") for path in tmp_path.glob("*.svg")}
    drawn = {name: text.count('<g id="text_') for name, text in texts.items()}
    assert drawn["placed"] == drawn["earlier"] == drawn["none"] + 1 == drawn["right"] + 1
    assert "lay 65.00 m farther along" in texts["placed"]
    assert "lay 65.00 m earlier" in texts["earlier"]
