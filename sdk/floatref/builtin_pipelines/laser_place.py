"""A laser beside its accelerometer: its height is carried there, and that is recorded."""

from collections.abc import Mapping, Sequence
from typing import Any

from floatref.estimators.kalman.inputs import IMU
from floatref.interfaces.pipeline import Context
from floatref.stages.protocol import Stage
from floatref.values.block import Header
from floatref.values.recording import Setup, TrackSetup
from floatref.vehicle_response.stages import Abeam


def carry_height(context: Context) -> Sequence[Stage]:
    """Carry the height to the accelerometer: by the measured attitude, else by a modelled pitch.

    Nothing is done where every laser is under its accelerometer. A modelled pitch has no roll, so
    that a lever to the side counts only where the attitude is measured.
    """
    levers = levers_of(context.header)
    if set(IMU) <= set(context.pipeline.channels):
        if any(map(any, levers.values())):
            from floatref.estimators.laser_place import HeightByAttitude

            return (HeightByAttitude(levers),)
    elif any(x for x, _ in levers.values()):
        from floatref.estimators.laser_place import HeightByModel

        return (HeightByModel({t: x for t, (x, _) in levers.items()}),)
    return ()


def levers_of(header: Header) -> dict[str, tuple[float, float]]:
    """Return each wheel path's laser ahead of and to the left of its accelerometer, in m."""
    offsets = {track: header.setup.track(track).laser_offset_m for track in header.tracks}
    return {track: (x, y) for track, (x, y, _) in offsets.items()}


def bring_abeam(setup: Setup, tracks: Sequence[str]) -> Sequence[Stage]:
    """Return what puts all wheel paths on the axis of the first laser; nothing if they are abeam.

    Each laser is over a place when the encoder reads less by as much as it is ahead.
    """
    shifts = _shifts_m(setup, tracks)
    return (Abeam(shifts),) if any(shifts.values()) else ()


def record_laser(setup: Setup, tracks: Sequence[str], stages: Sequence[Stage]) -> Mapping[str, Any]:
    """Return what was done about each wheel path's laser, for the profile's record.

    ``pitch`` is how its lever was overcome: "measured", "modelled", "ignored", or "not needed".
    """
    carried = {stage.name for stage in stages if getattr(stage, "levers_m", None)}
    how = "measured" if carried else "ignored"
    how = "modelled" if carried & {"HeightByModel", "LevelByRoad", "LevelTriggered"} else how
    found = {}
    for track, shift_m in _shifts_m(setup, tracks).items():
        place = setup.track(track)
        lever_m = place.laser_offset_m[0]
        found[track] = {
            "ahead_m": _ahead_m(place),
            "shift_m": shift_m,
            "lever_m": lever_m,
            "pitch": how if lever_m else "not needed",
        }
        if how == "modelled" and lever_m:
            found[track]["axles"] = "usual" if setup.axles is None else "setup"
    return found


def _shifts_m(setup: Setup, tracks: Sequence[str]) -> dict[str, float]:
    """Return by how much each laser is ahead of the first one; 0 for a place that is not stated."""
    ahead = {track: _ahead_m(setup.track(track)) for track in tracks if track in setup.tracks}
    first = next(iter(ahead.values()), 0.0)
    return {track: ahead.get(track, first) - first for track in tracks}


def _ahead_m(place: TrackSetup) -> float:
    return place.reference_point_m[0] + place.laser_offset_m[0]
