"""Errors that no level road, no laser at its accelerometer and no rolling wheel brings to light."""

import numpy as np

from floatref.measures import high_pass
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.classes import DeviceClass
from floatref_conformance.mutants import profiles as p
from floatref_conformance.mutants.engine import at_times
from floatref_conformance.mutants.in_fusion import ANGLES, Attitude, add_tilt_error, read_attitude
from floatref_conformance.mutants.mutation import AUGMENTED, Mutation

SLOPE_M = 4.0
"""Length in m over which a vehicle stands: the slope under it is the mean over its wheelbase."""


def _leave_gravity_out(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with what an attitude against the road in place of the horizon adds.

    A body that leans by θ on a slope β is tilted by β + θ. Without β, the share of gravity and of
    the deceleration that the slope turns into the accelerometer's axis is left in.
    """
    slope = _slope_under(profile, recording)
    return add_tilt_error(lambda true: Attitude(true.pitch + slope, true.roll))(profile, recording)


def _slope_under(profile: Profile, recording: Recording) -> FloatArray:
    """Return the slope under the vehicle, nose up, at every sample of the accelerometer."""
    mean = np.nan_to_num(np.mean([t.elevation for t in profile.tracks], axis=0))
    count = max(int(SLOPE_M / profile.interval_m), 1)
    smooth = np.convolve(np.pad(mean, count // 2, "edge"), np.full(count, 1 / count), "same")
    level = smooth[count // 2 : count // 2 + mean.size]
    slope = np.gradient(level, profile.interval_m)
    times = recording.channel("vertical_specific_force", profile.tracks[0].name).times_s
    encoder = recording.channel("distance")
    travelled = at_times(times, encoder.times_s, encoder.values)
    return np.asarray(np.interp(travelled, profile.distance_m, slope))


def _ignore_offset(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` with what a laser ahead of its accelerometer adds as the body pitches.

    At an offset l and a pitch θ, nose down positive, the laser is l·sin θ lower than the
    accelerometer, and the road seems so much higher.
    """
    angle = recording.channel(ANGLES[0])
    pitch = read_attitude(recording, angle.times_s).pitch
    encoder = recording.channel("distance")
    travelled = at_times(angle.times_s, encoder.times_s, encoder.values)

    def add(track: ProfileTrack) -> ProfileTrack:
        ahead_m = recording.setup.tracks[track.name].laser_offset_m[0]
        raised = ahead_m * np.sin(np.interp(profile.distance_m, travelled, pitch))
        z = track.elevation + high_pass(raised, profile.interval_m)
        return ProfileTrack.of(track.name, z, track.valid)

    return p.change_each(profile, add)


IN_SURROUNDINGS = (
    Mutation(
        "gravity-left-out",
        "leaves the slope of the road out of the tilt of its accelerometer",
        ("stop",),
        after=_leave_gravity_out,
        pipeline=AUGMENTED,
    ),
    Mutation(
        "offset-ignored",
        "takes the laser to be where its accelerometer is",
        ("braking",),
        after=_ignore_offset,
        pipeline=AUGMENTED,
    ),
    Mutation(
        "slip-believed",
        "places the road by its wheel as if it never slipped; as a device of class adequate",
        ("throttle", "braking", "near-stop", "stop"),
        pipeline=AUGMENTED,
        claims=DeviceClass.ADEQUATE,
    ),
)
"""Mutations that the roads, lasers and wheels of edition 2026.2 bring to light."""
