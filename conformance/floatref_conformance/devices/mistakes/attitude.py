"""What a wrong attitude does to a profile: forces are turned into the wrong direction."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.devices.mistakes.mistake import After
from floatref_conformance.devices.mutant_engine import Signals, at_times, in_time

ANGLES = ("gnss_pitch", "gnss_roll")
FORCES = ("longitudinal_specific_force", "lateral_specific_force", "vertical_specific_force")
SMOOTH = 9
"""The angles are means over so many readings: noise of a receiver is not what is wrong."""


@dataclass(frozen=True, eq=False)
class Attitude:
    """Pitch, nose down positive, and roll, left side up positive, in rad; shapes (n,)."""

    pitch: FloatArray
    roll: FloatArray

    @property
    def up(self) -> FloatArray:
        """The direction up in body axes, shape (3, n)."""
        pitch, roll = self.pitch, self.roll
        return np.stack(
            [-np.sin(pitch), np.cos(pitch) * np.sin(roll), np.cos(pitch) * np.cos(roll)]
        )


Wrong = Callable[[Attitude], Attitude]
"""Returns what is taken for an attitude."""


def misled(wrong: Wrong) -> After:
    """Return what adds to every elevation what an attitude taken for a ``wrong`` one brings.

    The false acceleration goes the way of one that is measured; drifts are suppressed alike.
    """

    def spoil(profile: Profile, recording: Recording) -> Profile:
        tracks = tuple(
            ProfileTrack.of(
                t.name, t.elevation + _false(recording, t.name, profile, wrong), t.valid
            )
            for t in profile.tracks
        )
        return replace(profile, tracks=tracks)

    return spoil


def _false(recording: Recording, track: str, sound: Profile, wrong: Wrong) -> FloatArray:
    signals = Signals.of(recording, track)
    channels = [recording.channel(name, track) for name in FORCES]
    times = channels[-1].times_s
    forces = np.stack([at_times(times, c.times_s, c.values) for c in channels])
    true = _attitude(recording, times)
    acceleration = np.sum(forces * (wrong(true).up - true.up), axis=0)
    still = np.zeros_like(signals.height)
    return in_time()(replace(signals, acceleration=acceleration, height=still), sound)


def _attitude(recording: Recording, times: FloatArray) -> Attitude:
    """Return the attitude that the receiver tells; a receiver that is silent has a level one."""
    weights = np.full(SMOOTH, 1.0 / SMOOTH)
    rows = []
    for channel in (recording.channel(name) for name in ANGLES):
        values = np.convolve(
            np.pad(np.nan_to_num(channel.values), SMOOTH // 2, "edge"), weights, "valid"
        )
        rows.append(at_times(times, channel.times_s, values))
    return Attitude(*rows)
