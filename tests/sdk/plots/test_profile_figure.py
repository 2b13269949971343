"""The figure of a profile: solid where valid, dotted and shaded where not, with its share."""

import sys
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgba
from matplotlib.image import imread

from floatref.errors import InputError
from floatref.plots.figure import SHADE
from floatref.values.profile import Profile, ProfileTrack

INTERVAL = 0.25
COUNT = 400
MM = 1000.0


def profile(*valid: np.ndarray, high_m: float = 0.0) -> Profile:
    """Return a profile of a wheel path for each of ``valid``, ``high_m`` off where invalid."""
    tracks = []
    for seed, mask in enumerate(valid):
        z = np.cumsum(np.random.default_rng(seed).normal(0.0, 5e-4, COUNT))
        tracks.append(ProfileTrack.of(f"path {seed}", z + high_m * ~mask, mask))
    return Profile(INTERVAL, tuple(tracks), start_m=100.0, pipeline="temporal-basic")


def part(first: int, end: int) -> np.ndarray:
    """Return validity, false from point ``first`` to point ``end``."""
    return (np.arange(COUNT) < first) | (np.arange(COUNT) >= end)


def drawn(line: Any) -> np.ndarray:
    """Return the indices of the points that ``line`` draws."""
    finite = np.isfinite(line.get_ydata())
    return np.flatnonzero(finite)


@pytest.mark.slow
@given(st.integers(0, COUNT - 1), st.integers(0, COUNT), st.booleans())
def test_every_point_is_drawn_solid_if_valid_and_dotted_if_not(
    first: int, end: int, second: bool
) -> None:
    masks = [part(first, end)] + [part(0, 0)] * second
    upper, _ = profile(*masks).plot().axes
    lines = upper.get_lines()
    assert len(lines) == 2 * len(masks)
    for mask, solid, dotted in zip(masks, lines[::2], lines[1::2], strict=True):
        assert (solid.get_linestyle(), dotted.get_linestyle()) == ("-", ":")
        assert solid.get_color() == dotted.get_color()
        assert drawn(solid).tolist() == np.flatnonzero(mask).tolist()
        assert set(np.flatnonzero(~mask)) <= set(drawn(dotted))
        # Beyond the invalid points the dotted line has their neighbours alone.
        assert drawn(dotted).size <= np.count_nonzero(~mask) + 2 * (~mask).any()


def test_what_is_invalid_in_any_wheel_path_is_shaded() -> None:
    figure = profile(part(100, 200), part(150, 300)).plot()
    for ax in figure.axes:
        (shade,) = ax.collections
        assert tuple(shade.get_facecolor()[0]) == to_rgba(SHADE)
        (path,) = shade.get_paths()
        span = path.vertices[:, 0].min(), path.vertices[:, 0].max()
        assert span == pytest.approx((100.0 + 100 * INTERVAL, 100.0 + 300 * INTERVAL), abs=INTERVAL)
    assert not any(ax.collections for ax in profile(part(0, 0)).plot().axes)


def test_axes_have_units_and_legends_the_share_of_each_mean() -> None:
    run = profile(part(200, COUNT), part(10, COUNT), high_m=1.0)
    upper, lower = run.plot().axes
    assert upper.get_ylabel() == "Elevation (mm)"
    assert "(m/km)" in lower.get_ylabel()
    assert lower.get_xlabel() == "Distance (m)"
    texts = [text.get_text() for text in lower.get_legend().get_texts()]
    value = run.iri()["path 0"].valid_m_per_km
    assert texts == [f"path 0: IRI {value:.2f} m/km over 49.9 %", "path 1: no IRI of valid points"]
    assert "not valid" in [text.get_text() for text in upper.get_legend().get_texts()]


def test_metres_that_are_not_valid_do_not_flatten_the_road() -> None:
    upper, _ = profile(part(100, 200), high_m=50.0).plot().axes
    low, high = upper.get_ylim()
    valid = MM * profile(part(100, 200))["path 0"].elevation[part(100, 200)]
    assert low < valid.min() < valid.max() < high
    assert high - low < 2.0 * (valid.max() - valid.min())


@pytest.mark.slow
@pytest.mark.parametrize("elevation", [[0.0], [np.nan], [np.nan] * 100, [0.0, 0.1], [1.0] * 500])
def test_every_profile_is_drawn(elevation: list[float]) -> None:
    track = ProfileTrack.of("$x^$", elevation)
    for interval_m in (INTERVAL, 5.0):
        assert Profile(interval_m, (track,)).plot()._repr_png_()


def test_a_notebook_gets_a_picture(tmp_path) -> None:
    picture = tmp_path / "p.png"
    picture.write_bytes(profile(part(100, 200)).plot()._repr_png_())
    assert imread(picture).shape[1] > 700


def test_a_missing_matplotlib_and_an_impossible_road_are_refused_in_one_line(monkeypatch) -> None:
    high = Profile(INTERVAL, (ProfileTrack.of("left", np.full(COUNT, 2e6)),))
    with pytest.raises(InputError, match=r"elevation of point 0 is 2e\+06 m"):
        high.plot()
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(InputError, match=r"needs matplotlib; .*-e \"\.\[plot\]"):
        profile(part(0, 0)).plot()
