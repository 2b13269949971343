"""What a profile shows of itself: one short line, a small table, its wheel paths by name."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack

NAMES = st.lists(st.text(min_size=1), min_size=1, max_size=8, unique=True)
LONGEST_LINE = 400


def profile(names: list[str], count: int = 10, pipeline: str = "temporal-basic") -> Profile:
    valid = np.arange(count) >= count // 4
    tracks = tuple(ProfileTrack.of(name, np.zeros(count), valid) for name in names)
    return Profile(0.00508, tracks, pipeline=pipeline)


@given(NAMES, st.integers(1, 5000), st.text())
def test_its_line_is_short_whatever_its_names_and_length(
    names: list[str], count: int, pipeline: str
) -> None:
    run = profile(names, count, pipeline)
    for value in (run, *run.tracks):
        assert len(repr(value)) <= LONGEST_LINE
        assert repr(value).isprintable()


def test_its_line_has_length_interval_pipeline_and_the_valid_share() -> None:
    line = repr(profile(["left", "right"], 101))
    assert line == (
        "Profile(0.51 m every 5.08 mm, temporal-basic; left 75.2 % valid, right 75.2 % valid)"
    )
    track = ProfileTrack.of("left", [0.0, 1.0], [True, False], [0.1, 0.1])
    assert repr(track) == "ProfileTrack(2 points, left 50.0 % valid, with sigma)"
    assert "no pipeline named" in repr(Profile(1.0, (track,)))


def test_its_table_is_about_valid_points() -> None:
    track = ProfileTrack.of("<left>", [0.25, 7.0, 0.5], [True, False, True], [0.001, 9.0, 0.003])
    page = Profile(0.25, (track,))._repr_html_()
    assert "&lt;left&gt;" in page
    assert "<left>" not in page
    assert "0.25 to 0.5 m" in page
    assert "2 mm" in page
    assert "66.7 %" in page


def test_a_table_without_a_valid_point_has_dashes() -> None:
    track = ProfileTrack.of("left", [np.nan, 1.0], [False, False], [np.nan, 0.1])
    page = Profile(0.25, (track,))._repr_html_()
    assert page.count("<td>–</td>") == 2
    assert "0.0 %" in page


@given(NAMES)
def test_wheel_paths_are_found_by_their_names(names: list[str]) -> None:
    run = profile(names)
    assert list(run) == names == run._ipython_key_completions_()
    for name in names:
        assert name in run
        assert run[name] is run.track(name)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("lift", "track lift: missing; the profile holds left, right; did you mean left?"),
        ("xyz", "track xyz: missing; the profile holds left, right"),
        (0, "track 0: missing; the profile holds left, right"),
    ],
)
def test_an_unknown_name_is_refused_with_the_nearest(name: str, text: str) -> None:
    run = profile(["left", "right"])
    with pytest.raises(InputError) as refusal:
        run[name]
    assert str(refusal.value) == text
    assert name not in run
