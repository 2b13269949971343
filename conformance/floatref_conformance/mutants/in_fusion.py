"""Errors of a profiler with an inertial unit and a GNSS receiver."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from floatref.measures import high_pass
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.mutants import profiles as p
from floatref_conformance.mutants.engine import Signals, at_times, in_time
from floatref_conformance.mutants.mutation import AUGMENTED, After, Mutation

ANGLES = ("gnss_pitch", "gnss_roll")
FORCES = ("longitudinal_specific_force", "lateral_specific_force", "vertical_specific_force")
SMOOTH = 9
"""Number of readings over which the angles are averaged, to remove the receiver's noise."""


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
"""Returns the wrong attitude for a true one."""


def add_tilt_error(wrong: Wrong) -> After:
    """Return a mutation that adds the elevation error of a ``wrong`` attitude.

    The false acceleration is processed like a measured one; its drift is suppressed too.
    """

    def mutate(profile: Profile, recording: Recording) -> Profile:
        tracks = tuple(
            ProfileTrack.of(
                t.name, t.elevation + _tilt_elevation(recording, t.name, profile, wrong), t.valid
            )
            for t in profile.tracks
        )
        return replace(profile, tracks=tracks)

    return mutate


def _tilt_elevation(recording: Recording, track: str, sound: Profile, wrong: Wrong) -> FloatArray:
    signals = Signals.of(recording, track)
    channels = [recording.channel(name, track) for name in FORCES]
    times = channels[-1].times_s
    forces = np.stack([at_times(times, c.times_s, c.values) for c in channels])
    true = read_attitude(recording, times)
    acceleration = np.sum(forces * (wrong(true).up - true.up), axis=0)
    still = np.zeros_like(signals.height)
    return in_time()(replace(signals, acceleration=acceleration, height=still), sound)


def read_attitude(recording: Recording, times: FloatArray) -> Attitude:
    """Return the attitude measured by the receiver; level while it is silent."""
    weights = np.full(SMOOTH, 1.0 / SMOOTH)
    rows = []
    for channel in (recording.channel(name) for name in ANGLES):
        values = np.convolve(
            np.pad(np.nan_to_num(channel.values), SMOOTH // 2, "edge"), weights, "valid"
        )
        rows.append(at_times(times, channel.times_s, values))
    return Attitude(*rows)


LOST_S = 1.0
"""A receiver without a fix for longer than this has an outage."""


def _invert_pitch(true: Attitude) -> Attitude:
    return Attitude(-true.pitch, true.roll)


def _read_degrees(true: Attitude) -> Attitude:
    turned = (angle[0] + np.degrees(angle - angle[0]) for angle in (true.pitch, true.roll))
    return Attitude(*turned)


def _swap(true: Attitude) -> Attitude:
    return Attitude(true.roll, true.pitch)


def _step_after_outage(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with a step of 20 mm, high-pass filtered, where each outage ends."""
    quality = recording.channel("gnss_quality")
    times = quality.times_s[quality.values == 4.0]
    ends_s = times[1:][np.diff(times) > LOST_S]
    encoder = recording.channel("distance")
    seen = np.isfinite(encoder.values)
    ends_m = np.interp(ends_s, encoder.times_s[seen], encoder.values[seen])
    step = 0.02 * np.sum(profile.distance_m[:, None] > ends_m[None, :], axis=1)
    return p.change_elevation(lambda z, made: z + high_pass(step, made.interval_m))(
        profile, recording
    )


IN_FUSION = (
    Mutation(
        "pitch-sign",
        "takes nose up for nose down",
        ("braking", "near-stop", "stop"),
        after=add_tilt_error(_invert_pitch),
        pipeline=AUGMENTED,
    ),
    Mutation(
        "rates-in-degrees",
        "takes deg/s for rad/s",
        ("braking", "near-stop", "stop"),
        after=add_tilt_error(_read_degrees),
        pipeline=AUGMENTED,
    ),
    Mutation(
        "rates-swapped",
        "takes roll for pitch and pitch for roll",
        ("braking", "near-stop"),
        after=add_tilt_error(_swap),
        pipeline=AUGMENTED,
    ),
    Mutation(
        "steps-after-an-outage",
        "steps by 20 mm when the receiver is back",
        ("faults",),
        after=_step_after_outage,
        pipeline=AUGMENTED,
    ),
)
"""Mutations of the fusion of several sensors."""
