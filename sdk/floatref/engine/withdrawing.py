"""Points of a profile that are not valid because a sensor is in doubt there."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.arrays import BoolArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording


def withdraw(
    profile: Profile, recording: Recording, doubts: Iterable[Doubt], reach_m: float
) -> Profile:
    """Return ``profile`` with no valid point within ``reach_m`` of a stretch in doubt.

    A doubt about a sensor of one wheel path concerns that path alone. Samples that a doubt replaces
    are flagged on their way through the stages.
    """
    asked = [doubt for doubt in doubts if not doubt.replaced]
    if not asked:
        return profile
    encoder = recording.channel("distance", recording.tracks[0])
    tracks = []
    for track in profile.tracks:
        valid = np.array(track.valid)
        for doubt in asked:
            if any(name.track in (None, track.name) for name in doubt.suspects):
                valid &= ~_concerned(profile, encoder, doubt, reach_m)
        tracks.append(ProfileTrack.of(track.name, track.elevation, valid, track.sigma))
    return replace(profile, tracks=tuple(tracks))


def _concerned(profile: Profile, encoder: Channel, doubt: Doubt, reach_m: float) -> BoolArray:
    """Return the points of ``profile`` in the stretches of ``doubt``."""
    places = profile.distance_m
    if doubt.whole_run:
        return np.ones(places.size, np.bool_)
    known = ~np.isnan(encoder.values)
    times, far = encoder.times_s[known], np.maximum.accumulate(encoder.values[known])
    found = np.zeros(places.size, np.bool_)
    for begin_s, end_s in doubt.spans:
        begin_m, end_m = np.interp([begin_s, end_s], times, far)
        open_end = not np.isfinite(end_s)
        found |= (places >= begin_m - reach_m) & (open_end | (places <= end_m + reach_m))
    return found
