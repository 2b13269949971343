"""`to_pandas` and `to_xarray` are the views that plug-ins register; a missing library is named."""

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from floatref import Channel, InputError, Profile, ProfileTrack, Recording, UniformClock, hookimpl
from floatref.engine.plugins import Plugins
from floatref.notebook import tables

pytest.importorskip("pandas", reason="tables are pandas frames; it comes with floatref[adapters]")
pytest.importorskip("xarray", reason="tables are xarray sets; it comes with floatref[adapters]")

LEFT = ProfileTrack.of("left", [0.5, np.nan, 1.5], sigma=[0.1, 0.2, 0.3])
RIGHT = ProfileTrack.of("right", [1.0, 2.0, 3.0], [True, False, True])
PROFILE = Profile(0.25, (LEFT, RIGHT), 2.0, "temporal-basic")
CHANNEL = Channel.of("height", [0.3, 0.4], UniformClock.of(1000.0), "left")
RECORDING = Recording((CHANNEL,))


def test_a_frame_has_every_track_by_distance_with_units() -> None:
    frame = PROFILE.to_pandas()
    assert (frame.index.name, frame.index.tolist()) == ("distance_m", [2.0, 2.25, 2.5])
    for track in PROFILE.tracks:
        np.testing.assert_array_equal(frame[f"{track.name}_elevation_m"], track.elevation)
        np.testing.assert_array_equal(frame[f"{track.name}_valid"], track.valid)
    np.testing.assert_array_equal(frame["left_sigma_m"], LEFT.sigma)
    units = frame.attrs["units"]
    metres = {"distance_m", "left_elevation_m", "left_sigma_m", "right_elevation_m"}
    assert units == dict.fromkeys(metres, "m")


def test_a_data_set_has_every_track_by_distance_with_units() -> None:
    found = PROFILE.to_xarray()
    assert dict(found.sizes) == {"track": 2, "distance": 3}
    for track in PROFILE.tracks:
        np.testing.assert_array_equal(found["elevation"].sel(track=track.name), track.elevation)
        np.testing.assert_array_equal(found["valid"].sel(track=track.name), track.valid)
    for name in ("elevation", "sigma", "distance"):
        assert found[name].attrs["units"] == "m"


def test_a_recording_has_its_samples_by_time() -> None:
    (frame,) = RECORDING.to_pandas()
    assert frame["left.height"].tolist() == [0.3, 0.4]
    assert frame.index.name == "time_s"
    assert frame.attrs["units"] == {"left.height": "m"}
    found = RECORDING.to_xarray()["left.height"]
    assert found.values.tolist() == [0.3, 0.4]
    assert found.attrs["units"] == "m"


@pytest.mark.parametrize("library", ["pandas", "xarray"])
@pytest.mark.parametrize("value", [PROFILE, RECORDING])
def test_a_missing_library_is_named_with_its_extra(
    monkeypatch: pytest.MonkeyPatch, value: Profile | Recording, library: str
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(InputError, match=rf"needs {library}; .*\.\[adapters\]"):
        getattr(value, f"to_{library}")()


class Vendor:
    """A plug-in that registers ``view`` under ``name``."""

    def __init__(self, name: Any, view: Any) -> None:
        self.name, self.view = name, view

    @hookimpl
    def floatref_register_views(self, register: Callable[[Any, Any], None]) -> None:
        """Register the view."""
        register(self.name, self.view)


def loaded(monkeypatch: pytest.MonkeyPatch, *vendors: Vendor) -> Plugins:
    made = Plugins()
    for number, vendor in enumerate(vendors):
        made.add(vendor, f"vendor {number}")
    monkeypatch.setattr(tables, "plugins", lambda: made)
    return made


def test_a_plug_in_makes_the_table(monkeypatch: pytest.MonkeyPatch) -> None:
    loaded(monkeypatch, Vendor("profile_to_pandas", lambda profile: [profile]))
    assert PROFILE.to_pandas() == [PROFILE]
    with pytest.raises(InputError, match="view profile_to_xarray: no plug-in registers it"):
        PROFILE.to_xarray()


@pytest.mark.parametrize(("name", "view"), [(7, print), ("profile_to_pandas", "no function")])
def test_what_is_no_view_is_reported_and_skipped(
    monkeypatch: pytest.MonkeyPatch, name: Any, view: Any
) -> None:
    made = loaded(monkeypatch, Vendor(name, view))
    with pytest.raises(InputError, match="no plug-in registers it"):
        PROFILE.to_pandas()
    assert len(made.reports) == 1
    assert "is not the name of a view" in made.reports[0]
