"""Pictures in metric and US units show the same values, and long lines keep their extremes."""

import numpy as np
import pytest

from floatref.plots.figure import BINS
from floatref.plots.profile_figure import profile_figure
from floatref.plots.recording_figure import recording_figure
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording

COUNT = 20 * BINS


def profile() -> Profile:
    z = np.cumsum(np.random.default_rng(0).normal(0.0, 1e-5, 4000))
    valid = np.arange(z.size) < 3000
    return Profile(0.1, (ProfileTrack.of("left", z, valid),), start_m=10.0, pipeline="test")


def recording() -> Recording:
    clock = UniformClock.of(1000.0, 7.0)
    force = 9.8 + np.random.default_rng(0).normal(size=COUNT)
    force[COUNT // 2] = 30.0
    far = 500.0 + np.arange(COUNT) * 0.01
    channels = [Channel.of("vertical_specific_force", force, clock, "left")]
    channels += [
        Channel.of("distance", far, clock),
        Channel.of("gnss_height", far * 0 + 580, clock),
    ]
    return Recording(tuple(channels))


def test_a_profile_in_us_units_is_the_same_profile() -> None:
    (si, si_rough), (us, us_rough) = (profile_figure(profile(), u).axes for u in ("si", "us"))
    assert (si.get_ylabel(), us.get_ylabel()) == ("Elevation (mm)", "Elevation (in)")
    assert (si_rough.get_xlabel(), us_rough.get_xlabel()) == ("Distance (m)", "Distance (ft)")
    for metric, customary in zip(si.get_lines(), us.get_lines(), strict=True):
        np.testing.assert_allclose(0.3048 * customary.get_xdata(), metric.get_xdata())
        np.testing.assert_allclose(25.4 * customary.get_ydata(), metric.get_ydata())
    for metric, customary in zip(si_rough.get_lines(), us_rough.get_lines(), strict=True):
        np.testing.assert_allclose(customary.get_ydata(), 63.36 * metric.get_ydata())
    value = 63.36 * profile().iri()["left"].valid_m_per_km
    label = us_rough.get_legend().get_texts()[0].get_text()
    assert f"IRI {value:.1f} in/mi over 75.0 %" in label


def test_a_heading_replaces_the_title() -> None:
    assert profile_figure(profile(), heading="$x$").axes[0].get_title(loc="left") == "$x$"


@pytest.mark.parametrize(
    ("units", "titles", "factor"),
    [
        (None, ["(m/s^2)", "(m)", "(m)"], 1.0),
        ("si", ["(m/s²)", "(m)", "(m)"], 1.0),
        ("us", ["(g)", "(ft)", "(ft)"], 1.0 / 9.80665),
    ],
)
def test_a_spike_of_a_long_channel_is_drawn(
    units: str | None, titles: list[str], factor: float
) -> None:
    axes = recording_figure(recording(), units, origin_s=7.0).axes
    assert [ax.get_title(loc="left").split()[-1] for ax in axes] == titles
    (line,) = axes[0].get_lines()
    assert line.get_ydata().size <= 4 * BINS
    force = recording().channel("vertical_specific_force", "left").values
    assert line.get_ydata().max() == pytest.approx(factor * 30.0)
    assert line.get_ydata().min() == pytest.approx(factor * force.min())
    at = line.get_xdata()[line.get_ydata().argmax()]
    assert at == pytest.approx(COUNT / 2000.0, abs=COUNT / 1000.0 / BINS)
