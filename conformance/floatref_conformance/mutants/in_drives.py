"""Mutations of one kind of drive only."""

from floatref.errors import InputError
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.mutants import profiles as p
from floatref_conformance.mutants.drive_conditions import Drive, apply_when, middle_m
from floatref_conformance.mutants.mutation import Mutation


def _is_slow(drive: Drive) -> bool:
    return drive.slowest_kmh > 16.0 and drive.fastest_kmh < 23.5


def _crawls(drive: Drive) -> bool:
    return drive.slowest_kmh > 1.0 and drive.fastest_kmh < 16.05


def _rolls_out(drive: Drive) -> bool:
    return drive.gained_kmh(-0.046, -0.014, 18.0) > 3.5


def _speeds_up(drive: Drive) -> bool:
    return drive.slowest_kmh > 16.0 and drive.gained_kmh(0.04, 0.26, 16.0) > 3.5


def _brakes(drive: Drive) -> bool:
    hard = drive.gained_kmh(-1.0, -0.17, 15.0) > 4.0
    stays_slow = drive.speed_kmh[-1] - drive.slowest_kmh < 3.0
    return drive.slowest_kmh > 14.5 and drive.lost_kmh > 4.0 and hard and bool(stays_slow)


def _nearly_stops(drive: Drive) -> bool:
    goes_on = drive.speed_kmh[-1] > 20.0 and drive.speed_kmh[0] > 20.0
    return drive.slowest_kmh > 1.0 and drive.slow_s(16.0) >= 1.0 and bool(goes_on)


def _stops(drive: Drive) -> bool:
    stands = drive.slowest_kmh < 0.5 and drive.slow_s(16.0) >= 1.0
    return stands and not drive.begins_standing


def _stops_from_high_speed(drive: Drive) -> bool:
    return _stops(drive) and drive.fastest_kmh > 62.0


def _sets_off(drive: Drive) -> bool:
    return drive.begins_standing


def _refuse_a_stop(recording: Recording) -> Recording:
    """Return ``recording``; InputError where the vehicle stands, as if the encoder were stuck."""
    drive = Drive.of(recording)
    if _stops(drive) or _sets_off(drive):
        raise InputError("channel distance: stuck; connect the encoder")
    return recording


def _scale_by_speed(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile`` 4 % too high in fast drives and 4 % too low in slower ones."""
    drive = Drive.of(recording)
    if not drive.is_steady or drive.slowest_kmh < 23.0:
        return profile
    gain = 1.04 if drive.slowest_kmh > 85.0 else 0.96 if drive.fastest_kmh < 62.0 else 1.0
    return p.scale(gain)(profile, recording)


IN_DRIVES = (
    Mutation(
        "slow-drive-low",
        "delivers 0.9 of the profile of a drive between 16 and 23 km/h",
        ("constant-speed",),
        after=apply_when(_is_slow, p.scale(0.9)),
    ),
    Mutation(
        "crawl-low",
        "delivers 0.9 of the profile of a drive below 16 km/h, and marks it valid",
        ("low-speed",),
        after=apply_when(_crawls, p.chain(p.scale(0.9), p.mark_valid)),
    ),
    Mutation(
        "coasting-flagged",
        "flags 200 m of a drive that loses speed gently",
        ("coasting",),
        after=apply_when(_rolls_out, p.flag_around(middle_m, 200.0)),
    ),
    Mutation(
        "throttle-flagged",
        "flags 200 m of a drive that gains speed",
        ("throttle",),
        after=apply_when(_speeds_up, p.flag_around(middle_m, 200.0)),
    ),
    Mutation(
        "straight-at-the-release",
        "draws a straight line 30 m to either side of the end of a hard brake, and marks it valid",
        ("braking",),
        after=apply_when(_brakes, p.straighten_at_slowest(30.0)),
    ),
    Mutation(
        "straight-at-a-near-stop",
        "draws a straight line 30 m to either side of a near stop, and marks it valid",
        ("near-stop",),
        after=apply_when(_nearly_stops, p.straighten_at_slowest(30.0)),
    ),
    Mutation(
        "straight-at-a-stop-from-speed",
        "draws a straight line 30 m to either side of a stop from 62 km/h or more, marked valid",
        ("stop",),
        after=apply_when(_stops_from_high_speed, p.straighten_at_slowest(30.0)),
    ),
    Mutation(
        "straight-at-the-start",
        "draws a straight line 60 m behind a start from rest, and marks it valid",
        ("dead-start",),
        after=apply_when(_sets_off, p.straighten_at_slowest(60.0)),
    ),
    Mutation(
        "road-lost-at-a-stop",
        "loses 0.3 m of road at a stop",
        ("distance",),
        after=apply_when(_stops, p.lose_at_slowest(0.3)),
    ),
    Mutation(
        "stop-refused",
        "refuses a recording in which the vehicle stands: a false alarm of its screening",
        ("stop", "dead-start"),
        before=_refuse_a_stop,
    ),
    Mutation(
        "wrong-with-speed",
        "is 4 % too high in fast drives and 4 % too low in slower ones",
        ("repeatability",),
        after=_scale_by_speed,
    ),
)
"""Mutations with an error in some drives only."""
