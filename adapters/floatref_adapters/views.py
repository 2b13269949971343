"""Profiles and recordings as pandas frames and xarray data sets.

Samples are not copied where pandas or xarray can look at them where they are; they stay
read-only: take a `copy()` of a frame before changing it. A recording has one frame, or one
dimension, for every clock of its channels: nothing is resampled.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from floatref import Channel, Profile, Recording, UniformClock
from floatref_adapters.shared.profile_columns import DISTANCE, as_json, make_columns
from floatref_adapters.shared.refusals import library

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset


def to_pandas(profile: Profile) -> "DataFrame":
    """Return ``profile`` as a frame with index `distance_m`, columns as in a Parquet file.

    `attrs` holds `units` by column, interval_m, start_m, pipeline, settings and provenance. Raises
    InputError where pandas is missing.
    """
    pandas = library("pandas", "to_pandas")
    columns = make_columns(profile, 0, profile.tracks[0].elevation.size)
    index = pandas.Index(columns.pop(DISTANCE), name=DISTANCE, copy=False)
    frame = pandas.DataFrame(columns, index=index, copy=False)
    metres = (name for name in columns if name.endswith("_m"))
    frame.attrs = {
        "units": {DISTANCE: "m", **dict.fromkeys(metres, "m")},
        "interval_m": profile.interval_m,
        "start_m": profile.start_m,
        "pipeline": profile.pipeline,
        "settings": dict(profile.settings),
        "provenance": dict(profile.provenance),
    }
    return frame


def to_xarray(profile: Profile) -> "Dataset":
    """Return ``profile`` as a data set with dimensions `track` and `distance`.

    Variables are `elevation` and `sigma` in m and `valid`; `sigma` is NaN for a track without
    one, and left out if no track has it. Wheel paths come into one array, which copies them. The
    attributes hold text and numbers only, so that the set can be written as netCDF. Raises
    InputError where xarray is missing.
    """
    xarray = library("xarray", "to_xarray")
    tracks, dims = profile.tracks, ("track", "distance")
    metres = {"units": "m"}
    variables: dict[str, Any] = {
        "elevation": (dims, np.stack([t.elevation for t in tracks]), metres),
        "valid": (dims, np.stack([t.valid for t in tracks]), {"long_name": "trusted point"}),
    }
    if any(t.sigma is not None for t in tracks):
        unknown = np.broadcast_to(np.nan, tracks[0].elevation.shape)
        sigmas = np.stack([unknown if t.sigma is None else t.sigma for t in tracks])
        variables["sigma"] = (dims, sigmas, {**metres, "long_name": "1-sigma of elevation"})
    coords = {
        "track": [track.name for track in tracks],
        "distance": ("distance", profile.distance_m, metres),
    }
    attrs = {
        "interval_m": profile.interval_m,
        "start_m": profile.start_m,
        "pipeline": profile.pipeline,
        "settings": as_json(profile.settings, "settings"),
        "provenance": as_json(profile.provenance, "provenance"),
    }
    made: Dataset = xarray.Dataset(variables, coords, attrs)
    return made


def recording_to_pandas(recording: Recording) -> "list[DataFrame]":
    """Return the channels of ``recording``, one frame for every clock, with index `time_s`.

    Columns are called `<channel>` or `<track>.<channel>`; `attrs` holds `units` by column and, of
    a uniform clock, `rate_hz`. Raises InputError where pandas is missing.
    """
    pandas = library("pandas", "recording_to_pandas")
    frames = []
    for channels in _by_clock(recording):
        index = pandas.Index(channels[0].times_s, name="time_s", copy=False)
        columns = {_name(c): c.values for c in channels}
        frame = pandas.DataFrame(columns, index=index, copy=False)
        frame.attrs = {"units": {_name(c): c.unit for c in channels}, **_rate(channels[0])}
        frames.append(frame)
    return frames


def recording_to_xarray(recording: Recording) -> "Dataset":
    """Return ``recording`` as one data set with a dimension `time_1`, `time_2` … for every clock.

    Variables are called `<channel>` or `<track>.<channel>`, with their `units`; the coordinate of
    a uniform clock has its `rate_hz`. Raises InputError where xarray is missing.
    """
    xarray = library("xarray", "recording_to_xarray")
    variables: dict[str, Any] = {}
    coords: dict[str, Any] = {}
    for number, channels in enumerate(_by_clock(recording), 1):
        dim = f"time_{number}"
        coords[dim] = (dim, channels[0].times_s, {"units": "s", **_rate(channels[0])})
        for channel in channels:
            variables[_name(channel)] = (dim, channel.values, {"units": channel.unit})
    made: Dataset = xarray.Dataset(variables, coords)
    return made


def _by_clock(recording: Recording) -> list[list[Channel]]:
    """Return the channels of each clock: as many samples, taken at the same times."""
    groups: list[list[Channel]] = []
    for channel in recording.channels:
        for group in groups:
            if _same_times(channel, group[0]):
                group.append(channel)
                break
        else:
            groups.append([channel])
    return groups


def _same_times(one: Channel, other: Channel) -> bool:
    if one.values.size != other.values.size:
        return False
    if isinstance(one.clock, UniformClock) or isinstance(other.clock, UniformClock):
        return one.clock == other.clock
    return bool(np.array_equal(one.clock.times_s, other.clock.times_s))


def _rate(channel: Channel) -> dict[str, float]:
    clock = channel.clock
    return {"rate_hz": float(clock.rate)} if isinstance(clock, UniformClock) else {}


def _name(channel: Channel) -> str:
    track = channel.id.track
    return channel.id.name if track is None else f"{track}.{channel.id.name}"
