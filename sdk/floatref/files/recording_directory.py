"""The recording directory, `floatref-recording/1`."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.atomic import replace_directory
from floatref.files.document import plain, read_document, write_document
from floatref.files.samples import free_name, read_samples, write_samples
from floatref.files.schema import enforce
from floatref.files.sources import document_path, name_errors
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId, check_unit
from floatref.values.clock import Clock, StampedClock, UniformClock
from floatref.values.recording import (
    AxleSetup,
    Channel,
    Recording,
    Setup,
    TrackSetup,
    VehicleSetup,
)

DOCUMENT = "recording.json"
"""Name of the JSON file of a recording directory."""
FORMAT = "floatref-recording/1"
SCHEMA = "floatref-recording-1"
AXLE_FIELDS = "wheelbase_m", "front_axle_m"


def read_recording(path: Path) -> Recording:
    """Return the recording at ``path``, a directory or its recording.json.

    Samples are mapped read-only from their files. Raises InputError with one line naming the file,
    the channel and the value for anything that breaks the format.
    """
    source = document_path(path, DOCUMENT)
    document = _read_enforced(source)
    with name_errors(source):
        _check_files(document["channels"])
    clocks: dict[str, StampedClock] = {}
    channels = tuple(_channel(entry, source, clocks) for entry in document["channels"])
    device = document.get("device", {})
    with name_errors(source):
        setup = setup_of(document.get("setup", {}))
        return Recording(channels, setup, device.get("vendor", ""), device.get("model", ""))


def write_recording(recording: Recording, directory: Path, overwrite: bool = False) -> None:
    """Write ``recording`` as a new ``directory``, complete or not at all.

    A track's name becomes part of file names. Raises InputError if ``directory`` exists and
    ``overwrite`` is false, cannot be written, or if the recording breaks the format.
    """
    document, samples = _describe(recording)
    enforce(document, SCHEMA, directory)
    with replace_directory(directory, overwrite, DOCUMENT) as folder:
        for name, values in samples.items():
            write_samples(values, folder / name)
        write_document(document, folder / DOCUMENT)


def sample_files(document: Path) -> tuple[str, ...]:
    """Return the names of the sample files that the recording.json at ``document`` lists."""
    entries = _read_enforced(document)["channels"]
    names = [entry[key] for entry in entries for key in ("file", "time_file") if key in entry]
    return tuple(dict.fromkeys(names))


def _read_enforced(source: Path) -> dict[str, Any]:
    document = read_document(source)
    enforce(document, SCHEMA, source)
    checked: dict[str, Any] = document
    return checked


def _check_files(entries: Sequence[Mapping[str, Any]]) -> None:
    """Refuse one file for two quantities; two wheel paths may share a sensor and its file."""
    names: dict[str, str] = {}
    for entry in entries:
        other = names.setdefault(entry["file"], entry["name"])
        if other != entry["name"]:
            raise InputError(
                f"file {entry['file']}: listed for {other} and for {entry['name']}; "
                "give each quantity its own"
            )


def _channel(entry: Mapping[str, Any], source: Path, clocks: dict[str, StampedClock]) -> Channel:
    channel = ChannelId(entry["name"], entry.get("track"))
    with name_errors(source):
        check_unit(channel, entry["unit"])
    with name_errors(f"channel {channel}"):
        samples = read_samples(source.with_name(entry["file"]))
        clock = _clock(entry, source, clocks)
    with name_errors(source.with_name(entry["file"])):
        return Channel(channel, samples, clock)


def _clock(entry: Mapping[str, Any], source: Path, clocks: dict[str, StampedClock]) -> Clock:
    name = entry.get("time_file")
    if name is None:
        return UniformClock.of(entry["rate_hz"], entry["start_s"])
    if name not in clocks:
        path = source.with_name(name)
        times = read_samples(path)
        with name_errors(path):
            clocks[name] = StampedClock(times)
    return clocks[name]


def setup_of(entry: Mapping[str, Any]) -> Setup:
    """Return the setup from a document's ``entry``, which obeys its schema."""
    tracks = {
        name: TrackSetup(**_select(track, "reference_point_m", "laser_offset_m"))
        for name, track in entry.get("tracks", {}).items()
    }
    known = _select(entry, "profile_interval_m", "gnss_antenna_offset_m")
    axles = AxleSetup(**_select(entry["axles"], *AXLE_FIELDS)) if "axles" in entry else None
    return Setup(**known, tracks=tracks, vehicle=_vehicle(entry.get("vehicle")), axles=axles)


def _vehicle(entry: Mapping[str, Any] | None) -> VehicleSetup | None:
    if entry is None:
        return None
    return VehicleSetup(entry["model"], entry["parameters"], float(entry.get("x_m", 0.0)))


def _select(entry: Mapping[str, Any], *keys: str) -> dict[str, Any]:
    """Return the values of ``keys`` that ``entry`` has, vectors as tuples of floats."""
    found = {key: entry[key] for key in keys if key in entry}
    return {
        key: tuple(map(float, value)) if isinstance(value, list) else float(value)
        for key, value in found.items()
    }


def _describe(recording: Recording) -> tuple[dict[str, Any], dict[str, FloatArray]]:
    """Return the JSON document of ``recording`` and the samples of every file it names."""
    samples: dict[str, FloatArray] = {}
    entries = _entries(recording, samples)
    document = {"format": FORMAT, **describe_installation(recording), "channels": entries}
    return plain(document, "recording"), samples


def describe_installation(recording: Recording) -> dict[str, Any]:
    """Return what `recording.json` holds beside the channels: ``device`` and ``setup``."""
    setup = recording.setup
    document = {
        "device": {"vendor": recording.vendor, "model": recording.model},
        "setup": {
            "profile_interval_m": setup.profile_interval_m,
            "gnss_antenna_offset_m": setup.gnss_antenna_offset_m,
            "tracks": {name: vars(track) for name, track in setup.tracks.items()},
            **_describe_vehicle(setup.vehicle),
            **({} if setup.axles is None else {"axles": vars(setup.axles)}),
        },
    }
    return {**plain(document, "recording")}


def _describe_vehicle(vehicle: VehicleSetup | None) -> dict[str, Any]:
    if vehicle is None:
        return {}
    numbers = {"x_m": vehicle.x_m, "parameters": dict(vehicle.parameters)}
    return {"vehicle": {"model": vehicle.model, **numbers}}


def _entries(recording: Recording, samples: dict[str, FloatArray]) -> list[dict[str, Any]]:
    """Return the document's entry of each channel; channels on one clock share its time file."""
    taken: set[str] = set()
    time_files: dict[int, str] = {}
    entries = []
    for channel in recording.channels:
        entry: dict[str, Any] = {"name": channel.id.name, "unit": channel.unit}
        if channel.id.track is not None:
            entry["track"] = channel.id.track
        entry["file"] = free_name(str(channel.id), ".f64", taken)
        samples[entry["file"]] = channel.values
        if isinstance(channel.clock, UniformClock):
            entry |= {"rate_hz": float(channel.clock.rate), "start_s": channel.clock.start_s}
        else:
            times = channel.clock.times_s
            if id(times) not in time_files:
                time_files[id(times)] = free_name(f"{channel.id}.time", ".f64", taken)
            entry["time_file"] = time_files[id(times)]
            samples[entry["time_file"]] = times
        entries.append(entry)
    return entries
