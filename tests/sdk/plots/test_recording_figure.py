"""The figure of a recording: a panel for each quantity, in its unit, with gaps shaded."""

import sys

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording


def recording(gap: slice = slice(0, 0)) -> Recording:
    clock = UniformClock.of(100.0, 5.0)
    height = np.linspace(0.2, 0.3, 300)
    height[gap] = np.nan
    channels = [Channel.of("height", height, clock, track) for track in ("left", "right")]
    channels.append(Channel.of("distance", np.arange(300.0), clock))
    channels.append(Channel.of("gnss_height", [1.0], StampedClock.of([6.0])))
    return Recording(tuple(channels))


def test_there_is_a_panel_for_each_quantity_and_a_line_for_each_channel() -> None:
    axes = recording().plot().axes
    titles = [ax.get_title(loc="left") for ax in axes]
    assert titles == ["height (m)", "distance (m)", "gnss_height (m)"]
    assert [len(ax.get_lines()) for ax in axes] == [2, 1, 1]
    assert axes[-1].get_xlabel() == "Time (s)"
    for line, track in zip(axes[0].get_lines(), ("left", "right"), strict=True):
        channel = recording().channel("height", track)
        np.testing.assert_array_equal(line.get_xdata(), channel.times_s)
        np.testing.assert_array_equal(line.get_ydata(), channel.values)


def test_missing_samples_are_shaded_where_they_are_and_named_once() -> None:
    upper, lower, _ = recording(slice(100, 200)).plot().axes
    assert not lower.collections
    for shade in upper.collections:
        times = shade.get_paths()[0].vertices[:, 0]
        assert (times.min(), times.max()) == pytest.approx((6.0, 7.0), abs=0.02)
    texts = [text.get_text() for text in upper.get_legend().get_texts()]
    assert texts == ["left", "right", "missing"]


def test_a_single_sample_is_seen() -> None:
    assert recording().plot().axes[-1].get_lines()[0].get_marker() == "."
    assert recording(slice(0, 300)).plot()._repr_png_()


def test_a_missing_matplotlib_is_named_with_its_extra(monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(InputError, match=r"needs matplotlib; .*-e \"\.\[plot\]"):
        recording().plot()
