"""One run of a device: its input folder, and the verification of its output."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

from floatref.errors import FloatrefError
from floatref.files import read_profile, write_recording
from floatref.files.scratch import scratch_folder
from floatref.files.sources import real_path
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.devices.delivered import take
from floatref_conformance.devices.interface import Description, Device, visible
from floatref_conformance.errors import DeviceError, DeviceRefused, DeviceSkipped
from floatref_conformance.room import TEMPORARY, bytes_of, needing_room

MAX_INTERVAL_M = 0.25
"""Largest profile interval from which the IRI can be computed, in m."""
MIN_INTERVAL_M = 0.001
"""Smallest profile interval, in m; a recording cannot request a smaller one."""
MAX_ELEVATION_M = 1e6
"""A larger elevation, in m, is an error of the device and not drift."""
ROUNDING_M = 1e-9
"""Of places in m: a limit that is met exactly is met."""

Answer = TypeVar("Answer")


def describe(device: Device) -> Description:
    """Return the description of ``device``; DeviceError if it gives no usable one."""
    return Description.of(_ask(lambda: device.describe()))


@dataclass(frozen=True)
class Delivery:
    """Where a profile may end.

    Attributes:
        early_m: length in m by which it may end before the recording; two intervals at least.
        true_end_m: the end along the true distance, for a device that knows it; None if it has to
            keep the encoder's.
    """

    early_m: float = 0.0
    true_end_m: float | None = None


def exercise(
    device: Device,
    description: Description,
    recording: Recording,
    delivery: Delivery | None = Delivery(),
) -> Profile:
    """Return the profile that ``device`` makes of ``recording``.

    Raises DeviceError if the profile is unusable, DeviceHung if it does not come in time,
    DeviceRefused for an error in its place, DeviceSkipped if the device does not process the
    recording, NoRoom if the disk is full.

    The device sees a new folder with a neutral name and the channels that it may receive. Without
    ``delivery`` any wheel paths and any axis are taken.
    """
    given = visible(recording, description.channels)
    with (
        scratch_folder("run") as made,
        needing_room(made.parent, bytes_of(given), TEMPORARY),
    ):
        folder = real_path(made)
        write_recording(given, folder / "recording")
        target = folder / "profile"
        try:
            _ask(lambda: device.run(folder / "recording" / "recording.json", target))
            profile = _read(target)
            if delivery is not None:
                _check_tracks(profile, given, description.owes)
                _check_axis(profile, given, delivery)
        except (DeviceError, DeviceSkipped) as fault:
            raise type(fault)(str(fault).replace(str(folder), "…")) from fault
    return profile


def _ask(question: Callable[[], Answer]) -> Answer:
    """Return the device's answer; DeviceError for any exception, sys.exit included.

    DeviceRefused for an error of floatref. DeviceError with its kinds and DeviceSkipped are passed
    on unchanged.
    """
    try:
        return question()
    except (DeviceError, DeviceSkipped):
        raise
    except (Exception, SystemExit) as error:
        text = " ".join(str(error).split())
        kind = DeviceRefused if isinstance(error, FloatrefError) else DeviceError
        raise kind(f"raised {type(error).__name__}: {text}") from error


def _read(target: Path) -> Profile:
    """Return the profile in ``target``, read from a copy and held in memory."""
    with scratch_folder("copy") as made:
        copy = real_path(made) / target.name
        take(target, copy)
        try:
            profile = read_profile(copy)
        except Exception as error:
            text = " ".join(str(error).split()).replace(str(copy.parent), "…")
            raise DeviceError(f"delivered an unusable profile: {text}") from error
        return hold_in_memory(profile)


def hold_in_memory(profile: Profile) -> Profile:
    """Return the points of ``profile`` without the files that hold them, which may then go."""
    tracks = tuple(
        ProfileTrack.of(
            t.name,
            np.array(t.elevation),
            np.array(t.valid),
            None if t.sigma is None else np.array(t.sigma),
        )
        for t in profile.tracks
    )
    return Profile(profile.interval_m, tracks, profile.start_m)


def _check_tracks(profile: Profile, recording: Recording, owed: str) -> None:
    """Raise DeviceError unless each wheel path with channel ``owed`` has usable elevations."""
    here = {track.name: track for track in profile.tracks}
    for name in recording.tracks:
        if recording.find(owed, name) is None:
            continue
        if name not in here:
            raise DeviceError(f"track {name}: not delivered, though it has a channel {owed}")
        finite = here[name].elevation[np.isfinite(here[name].elevation)]
        if finite.size and float(np.abs(finite).max()) > MAX_ELEVATION_M:
            raise DeviceError(f"track {name}: an elevation beyond {MAX_ELEVATION_M:g} m")


def _check_axis(profile: Profile, recording: Recording, delivery: Delivery) -> None:
    """Raise DeviceError unless the points cover the recorded distance, as ``delivery`` has it."""
    if profile.interval_m > MAX_INTERVAL_M:
        raise DeviceError(
            f"interval_m is {profile.interval_m:g}; an IRI needs {MAX_INTERVAL_M} m or less"
        )
    if profile.interval_m < MIN_INTERVAL_M:
        raise DeviceError(
            f"interval_m is {profile.interval_m:g}; at most 1000 points per metre are judged, "
            f"and the recording requests {recording.setup.profile_interval_m:g}"
        )
    distance = recording.channel("distance").values
    first, farthest = distance[~np.isnan(distance)][0], np.nanmax(distance)
    slack = 2.0 * max(profile.interval_m, recording.setup.profile_interval_m)
    end_m = profile.start_m + profile.length_m
    ends = [farthest] if delivery.true_end_m is None else [farthest, delivery.true_end_m]
    reached = any(-slack <= to - end_m <= max(slack, delivery.early_m) + ROUNDING_M for to in ends)
    if abs(profile.start_m - first) > slack or not reached:
        raise DeviceError(
            f"profile from {profile.start_m:.3f} m over {profile.length_m:.3f} m; "
            f"the recording goes from {first:.3f} m to {farthest:.3f} m"
        )


def early_end_m(profile: Profile, recording: Recording, true_end_m: float | None) -> float:
    """Return the length in m by which ``profile`` ends before ``recording``.

    It is 0 within two intervals, as where the last points are rounded off.
    """
    farthest = float(np.nanmax(recording.channel("distance").values))
    ends = [farthest] if true_end_m is None else [farthest, true_end_m]
    end_m = profile.start_m + profile.length_m
    lacking = min((to - end_m for to in ends), key=abs)
    slack = 2.0 * max(profile.interval_m, recording.setup.profile_interval_m)
    return lacking if lacking > slack else 0.0


def close(device: Device) -> str:
    """Close ``device`` and return its fault; empty if it closed without one."""
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
    """Closes ``device`` once; an interrupted closing is repeated."""

    device: Device
    done: bool = False

    def close(self) -> str:
        """Return the fault; empty without one or if the device is closed already."""
        fault = "" if self.done else close(self.device)
        self.done = True
        return fault


@contextmanager
def close_on_error(device: Device) -> Iterator[None]:
    """Close ``device`` if the body of the with statement raises."""
    try:
        yield
    except BaseException:
        close(device)
        raise
