"""Profiles and recordings as pandas frames and xarray data sets: same numbers, same places."""

import json
import sys

import numpy as np
import pytest

from floatref import (
    Channel,
    InputError,
    Profile,
    ProfileTrack,
    Recording,
    StampedClock,
    UniformClock,
)
from floatref_adapters.views import recording_to_pandas, recording_to_xarray, to_pandas, to_xarray

pytest.importorskip("pandas", reason="views are pandas frames; it comes with floatref[adapters]")
pytest.importorskip("xarray", reason="views are xarray sets; it comes with floatref[adapters]")

LEFT = ProfileTrack.of("left", [0.5, np.nan, 1.5], None, [0.1, 0.2, 0.3])
RIGHT = ProfileTrack.of("right", [1.0, 2.0, 3.0], [True, False, True])
PROFILE = Profile(0.25, (LEFT, RIGHT), 2.0, "temporal-basic", {"cutoff": np.nan}, {"by": "us"})


@pytest.fixture
def recording():
    fast, stamps = UniformClock.of(1000.0, 5.0), StampedClock.of([5.0, 5.1, 5.3])
    again = StampedClock.of([5.0, 5.1, 5.3])
    return Recording(
        (
            Channel.of("vertical_specific_force", [9.8, 9.9], fast, "left"),
            Channel.of("gnss_height", [1.0, 2.0, 3.0], stamps),
            Channel.of("height", [0.3, 0.4], UniformClock.of(1000.0, 5.0), "left"),
            Channel.of("gnss_vertical_velocity", [0.1, 0.2, np.nan], again),
            Channel.of("distance", [0.0, 1.0, 2.0], UniformClock.of(500.0, 5.0)),
        )
    )


def test_a_frame_of_a_profile():
    frame = to_pandas(PROFILE)
    assert frame.index.name == "distance_m"
    assert frame.index.tolist() == [2.0, 2.25, 2.5]
    assert list(frame) == [
        "left_elevation_m",
        "left_valid",
        "left_sigma_m",
        "right_elevation_m",
        "right_valid",
    ]
    np.testing.assert_array_equal(frame["left_elevation_m"], LEFT.elevation)
    assert frame["right_valid"].tolist() == [True, False, True]
    assert frame.attrs["interval_m"] == 0.25
    assert frame.attrs["provenance"] == {"by": "us"}
    assert frame["right_elevation_m"].mean() == 2.0


def test_a_frame_looks_at_the_samples_where_they_are():
    frame = to_pandas(PROFILE)
    assert np.shares_memory(frame["left_elevation_m"].to_numpy(), LEFT.elevation)
    with pytest.raises(ValueError, match="read-only"):
        frame.loc[2.0, "left_elevation_m"] = 9.0
    copy = frame.copy()
    copy.loc[2.0, "left_elevation_m"] = 9.0
    assert LEFT.elevation[0] == 0.5


def test_a_data_set_of_a_profile():
    found = to_xarray(PROFILE)
    assert dict(found.sizes) == {"track": 2, "distance": 3}
    left = found.sel(track="left")
    np.testing.assert_array_equal(left["elevation"], LEFT.elevation)
    np.testing.assert_array_equal(found["valid"].sel(track="right"), RIGHT.valid)
    np.testing.assert_array_equal(left["sigma"], LEFT.sigma)
    assert np.isnan(found["sigma"].sel(track="right")).all()
    assert found["elevation"].attrs["units"] == found["distance"].attrs["units"] == "m"
    assert float(found["elevation"].sel(track="right", distance=2.25)) == 2.0
    assert json.loads(found.attrs["settings"]) == {"cutoff": None}
    assert "sigma" not in to_xarray(Profile(0.25, (RIGHT,)))


def test_a_recording_has_a_frame_for_every_clock(recording):
    frames = recording_to_pandas(recording)
    assert [list(frame) for frame in frames] == [
        ["left.vertical_specific_force", "left.height"],
        ["gnss_height", "gnss_vertical_velocity"],
        ["distance"],
    ]
    assert [frame.index.tolist() for frame in frames] == [
        [5.0, 5.001],
        [5.0, 5.1, 5.3],
        [5.0, 5.002, 5.004],
    ]
    assert frames[0].attrs == {
        "units": {"left.vertical_specific_force": "m/s^2", "left.height": "m"},
        "rate_hz": 1000.0,
    }
    assert "rate_hz" not in frames[1].attrs
    height = recording.channel("height", "left")
    assert np.shares_memory(frames[0]["left.height"].to_numpy(), height.values)


def test_a_recording_has_a_dimension_for_every_clock(recording):
    found = recording_to_xarray(recording)
    assert dict(found.sizes) == {"time_1": 2, "time_2": 3, "time_3": 3}
    assert found["time_1"].attrs == {"units": "s", "rate_hz": 1000.0}
    assert found["time_2"].values.tolist() == [5.0, 5.1, 5.3]
    assert found["left.height"].dims == ("time_1",)
    assert found["distance"].attrs == {"units": "m"}
    for channel in recording.channels:
        name = ".".join(part for part in (channel.id.track, channel.id.name) if part)
        np.testing.assert_array_equal(found[name], channel.values)


@pytest.mark.parametrize(
    ("view", "library"),
    [
        (to_pandas, "pandas"),
        (to_xarray, "xarray"),
        (recording_to_pandas, "pandas"),
        (recording_to_xarray, "xarray"),
    ],
)
def test_a_missing_library_is_named_with_the_extra(monkeypatch, recording, view, library):
    monkeypatch.setitem(sys.modules, library, None)
    given = recording if view.__name__.startswith("recording") else PROFILE
    with pytest.raises(InputError, match=rf"{view.__name__} needs {library}; .*\.\[adapters\]"):
        view(given)
