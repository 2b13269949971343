"""The drawing of Allan deviations: a panel for each unit, measured and fitted, complete or not."""

from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.measures import ChannelNoise, channel_noise
from floatref.plots import draw_allan
from floatref.plots.figure import COLOURS
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel


def noise(
    name: str, track: str | None = None, walk: float = 0.0, size: float = 1.0
) -> ChannelNoise:
    rng = np.random.default_rng(0)
    x = rng.normal(size=5000) + walk * np.cumsum(rng.normal(size=5000))
    return channel_noise(Channel.of(name, size * x, UniformClock.of(10.0), track))


@pytest.mark.slow
def test_every_unit_has_a_panel_and_every_channel_its_name(tmp_path: Path) -> None:
    found = [noise("roll_rate"), noise("height", "left"), noise("height", "right")]
    draw_allan(found, tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert text.count('<g id="axes_') == 2
    for part in ("roll_rate", "left.height", "right.height", "Cluster time (s)", "(rad/s)", "(m)"):
        assert f"<!-- {part} -->" in text or part in text
    assert "Distance" not in text


@pytest.mark.slow
def test_each_channel_has_its_colour_over_all_cluster_times(tmp_path: Path, colour_share) -> None:
    draw_allan([noise("roll_rate"), noise("pitch_rate", walk=1.0)], tmp_path / "a.png")
    for colour in COLOURS[:2]:
        assert colour_share(tmp_path / "a.png", colour) > 0.3
    assert colour_share(tmp_path / "a.png", COLOURS[2]) == 0.0


@pytest.mark.slow
def test_letters_stand_for_the_terms_that_are_there(tmp_path: Path) -> None:
    draw_allan([noise("roll_rate")], tmp_path / "white.svg")
    draw_allan([noise("roll_rate", walk=0.1)], tmp_path / "walk.svg")
    white, walk = ((tmp_path / f"{n}.svg").read_text(encoding="utf-8") for n in ("white", "walk"))
    assert "<!-- N -->" in white
    assert "<!-- K -->" not in white
    assert "<!-- N -->" in walk
    assert "<!-- K -->" in walk


@pytest.mark.slow
def test_more_channels_than_colours_are_drawn(tmp_path: Path, colour_share) -> None:
    names = ("roll_rate", "pitch_rate", "yaw_rate")
    each = [(name, track) for name in names for track in ("left", "middle", "right")]
    found = [noise(name, track, size=1.5**k) for k, (name, track) in enumerate(each)]
    draw_allan(found, tmp_path / "a.png")
    for colour in COLOURS:
        assert colour_share(tmp_path / "a.png", colour) > 0.05


@pytest.mark.parametrize(
    ("name", "text"), [("nowhere/a.png", "its folder does not exist"), ("a.txt", "not the name")]
)
def test_an_unwritable_target_is_one_line(tmp_path: Path, name: str, text: str) -> None:
    with pytest.raises(InputError, match=text):
        draw_allan([noise("roll_rate")], tmp_path / name)
    assert not list(tmp_path.iterdir())
