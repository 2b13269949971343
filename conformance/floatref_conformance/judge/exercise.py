"""One run of a device: what it is given, where, and what it must have delivered."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import numpy as np

from floatref.files import read_profile, write_recording
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.devices.delivered import take
from floatref_conformance.devices.interface import Description, Device, visible
from floatref_conformance.errors import DeviceError, DeviceSkipped

MAX_INTERVAL_M = 0.25
"""Widest profile interval that still carries the IRI, in m."""
MIN_INTERVAL_M = 0.001
"""Closest profile interval, in m: as close as a recording may ask for, and one can be judged."""
MAX_ELEVATION_M = 1e6
"""An elevation beyond this, in m, is garbage and not drift."""

Answer = TypeVar("Answer")


def describe(device: Device) -> Description:
    """Return what ``device`` says of itself; DeviceError if it fails to."""
    return Description.of(_ask(lambda: device.describe()))


def exercise(device: Device, description: Description, recording: Recording) -> Profile:
    """Return the profile that ``device`` makes of ``recording``.

    Raises DeviceError if it is unusable, DeviceHung if there is none in time, DeviceSkipped if
    the device does not take the recording.

    The device sees a fresh folder of neutral name with the channels that it may have.
    """
    with TemporaryDirectory(ignore_cleanup_errors=True) as name:
        folder = Path(name).resolve()
        given = visible(recording, description.channels)
        write_recording(given, folder / "recording")
        target = folder / "profile"
        try:
            _ask(lambda: device.run(folder / "recording" / "recording.json", target))
            profile = _read(target)
            _check_tracks(profile, given, description.owes)
            _check_axis(profile, given)
        except (DeviceError, DeviceSkipped) as fault:
            raise type(fault)(str(fault).replace(str(folder), "…")) from fault
    return profile


def _ask(question: Callable[[], Answer]) -> Answer:
    """Return the device's answer; DeviceError for whatever it raises, sys.exit included.

    What it says of itself, DeviceHung and DeviceSkipped, is let through.
    """
    try:
        return question()
    except (DeviceError, DeviceSkipped):
        raise
    except (Exception, SystemExit) as error:
        text = " ".join(str(error).split())
        raise DeviceError(f"raised {type(error).__name__}: {text}") from error


def _read(target: Path) -> Profile:
    """Return the profile in ``target``, read from a copy and held in memory."""
    with TemporaryDirectory(ignore_cleanup_errors=True) as name:
        copy = Path(name).resolve() / target.name
        take(target, copy)
        try:
            profile = read_profile(copy)
        except Exception as error:
            text = " ".join(str(error).split()).replace(str(copy.parent), "…")
            raise DeviceError(f"delivered an unusable profile: {text}") from error
        tracks = tuple(
            ProfileTrack.of(t.name, np.array(t.elevation), np.array(t.valid))
            for t in profile.tracks
        )
    return Profile(profile.interval_m, tracks, profile.start_m)


def _check_tracks(profile: Profile, recording: Recording, owed: str) -> None:
    """Raise DeviceError unless every wheel path with channel ``owed`` came back, within reason."""
    here = {track.name: track for track in profile.tracks}
    for name in recording.tracks:
        if recording.find(owed, name) is None:
            continue
        if name not in here:
            raise DeviceError(f"track {name}: not delivered, though it has a channel {owed}")
        finite = here[name].elevation[np.isfinite(here[name].elevation)]
        if finite.size and float(np.abs(finite).max()) > MAX_ELEVATION_M:
            raise DeviceError(f"track {name}: an elevation beyond {MAX_ELEVATION_M:g} m")


def _check_axis(profile: Profile, recording: Recording) -> None:
    """Raise DeviceError unless the points cover the recorded distance, and no more."""
    if profile.interval_m > MAX_INTERVAL_M:
        raise DeviceError(
            f"interval_m is {profile.interval_m:g}; an IRI needs {MAX_INTERVAL_M} m or less"
        )
    if profile.interval_m < MIN_INTERVAL_M:
        raise DeviceError(
            f"interval_m is {profile.interval_m:g}; at most 1000 points per metre are judged, "
            f"and {recording.setup.profile_interval_m:g} was asked for"
        )
    distance = recording.channel("distance").values
    first, farthest = distance[~np.isnan(distance)][0], np.nanmax(distance)
    slack = 2.0 * max(profile.interval_m, recording.setup.profile_interval_m)
    ends = ((profile.start_m, first), (profile.start_m + profile.length_m, farthest))
    for delivered, recorded in ends:
        if abs(delivered - recorded) > slack:
            raise DeviceError(
                f"profile from {profile.start_m:.3f} m over {profile.length_m:.3f} m; "
                f"the recording goes from {first:.3f} m to {farthest:.3f} m"
            )


def close(device: Device) -> str:
    """Let ``device`` end what it has started, and return what went wrong, empty if nothing."""
    ending = getattr(device, "close", None)
    if ending is None:
        return ""
    try:
        _ask(ending)
    except (DeviceError, DeviceSkipped) as fault:
        return str(fault)
    return ""


@dataclass
class Closing:
    """Closes ``device`` once; one that was interrupted meanwhile is closed again."""

    device: Device
    done: bool = False

    def close(self) -> str:
        """Return what went wrong, empty if nothing did or the device is closed already."""
        fault = "" if self.done else close(self.device)
        self.done = True
        return fault


@contextmanager
def close_on_error(device: Device) -> Iterator[None]:
    """Close ``device`` if what is done with it fails before it is run."""
    try:
        yield
    except BaseException:
        close(device)
        raise
