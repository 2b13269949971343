"""What a profiler with an inertial unit and a GNSS receiver can get wrong."""

import numpy as np

from floatref.measures import high_pass
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.devices.mistakes import profiles as p
from floatref_conformance.devices.mistakes.attitude import Attitude, misled
from floatref_conformance.devices.mistakes.mistake import AUGMENTED, Mistake

LOST_S = 1.0
"""A receiver without a fix for longer than this has an outage."""


def _nose_up(told: Attitude) -> Attitude:
    return Attitude(-told.pitch, told.roll)


def _in_degrees(told: Attitude) -> Attitude:
    turned = (angle[0] + np.degrees(angle - angle[0]) for angle in (told.pitch, told.roll))
    return Attitude(*turned)


def _swapped(told: Attitude) -> Attitude:
    return Attitude(told.roll, told.pitch)


def _stepping(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with a step of 20 mm, high-pass filtered, where each outage ends."""
    quality = recording.channel("gnss_quality")
    times = quality.times_s[quality.values == 4.0]
    ends_s = times[1:][np.diff(times) > LOST_S]
    encoder = recording.channel("distance")
    seen = np.isfinite(encoder.values)
    ends_m = np.interp(ends_s, encoder.times_s[seen], encoder.values[seen])
    step = 0.02 * np.sum(profile.distance_m[:, None] > ends_m[None, :], axis=1)
    return p.elevation(lambda z, made: z + high_pass(step, made.interval_m))(profile, recording)


IN_FUSION = (
    Mistake(
        "pitch-sign",
        "takes nose up for nose down",
        ("braking", "near-stop", "stop"),
        after=misled(_nose_up),
        pipeline=AUGMENTED,
    ),
    Mistake(
        "rates-in-degrees",
        "takes deg/s for rad/s",
        ("braking", "near-stop", "stop"),
        after=misled(_in_degrees),
        pipeline=AUGMENTED,
    ),
    Mistake(
        "rates-swapped",
        "takes roll for pitch and pitch for roll",
        ("braking", "near-stop"),
        after=misled(_swapped),
        pipeline=AUGMENTED,
    ),
    Mistake(
        "steps-after-an-outage",
        "steps by 20 mm when the receiver is back",
        ("faults",),
        after=_stepping,
        pipeline=AUGMENTED,
    ),
)
"""What is wrong where several sensors are put together."""
