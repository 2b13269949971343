"""Where the height sensor dropped out, another estimate of the road fills the gap, flagged.

A plug-in makes that estimate, in the hook `temporal_fall_back`. Its elevation replaces the
profile's in the gap, plus a line that joins both at the gap's ends. The pipeline's high-pass filter
has spread the error of the bridged height beyond the gap; the correction passes the same filter,
which removes that error.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from floatref.intake.height_gaps import height_gaps
from floatref.interfaces.drop_out import DropOut
from floatref.measures import high_pass
from floatref.stages.signals import HEIGHT
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.channels import ChannelId
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording

MEETING_M = 5.0
"""Length in m beside a gap over which the means of both estimates are made equal."""
FEWEST = 0.5
"""Part of this length over which both must be known."""


def gaps_of(
    recording: Recording, profile: Profile, gone: Mapping[ChannelId, IndexArray]
) -> dict[str, FloatArray]:
    """Return the gaps of the heights as in `DropOut`; ``gone`` are damaged stretches."""
    names = [track.name for track in profile.tracks]
    found = {t: height_gaps(recording, t, gone[ChannelId(HEIGHT, t)]) for t in names}
    return {track: gaps for track, gaps in found.items() if len(gaps)}


def fill_gaps(asked: DropOut, estimate: Profile) -> tuple[Profile, tuple[str, ...]]:
    """Return the profile with its gaps filled from ``estimate``, and a line for each wheel path.

    A gap stays as it is if too few points beside it are known to join both. Filled points are
    invalid.
    """
    profile = asked.profile
    lines: list[str] = []
    tracks = []
    known = {track.name: track for track in estimate.tracks}
    for track in profile.tracks:
        if track.name in known and len(asked.gaps.get(track.name, ())):
            inside = _inside(profile, asked.gaps[track.name])
            gap = _Gap(profile, track, inside, *_on_points(profile, estimate, known[track.name]))
            track, length_m = gap.bridge()
            lines += _describe(track.name, estimate.pipeline, length_m)
        tracks.append(track)
    return replace(profile, tracks=tuple(tracks)), tuple(lines)


def _describe(track: str, pipeline: str, length_m: float) -> list[str]:
    if length_m == 0:
        return []
    return [
        f"track {track}: height missing over {length_m:.3g} m, where {pipeline} gives the "
        "elevation; flagged"
    ]


def _inside(profile: Profile, gaps: FloatArray) -> BoolArray:
    """Return which points of ``profile`` lie in ``gaps``, shape (N,)."""
    places = profile.distance_m
    inside = np.zeros(places.size, np.bool_)
    for begin, end in gaps:
        low, high = np.searchsorted(places, [begin, end])
        inside[low:high] = True
    return inside


def _on_points(
    profile: Profile, estimate: Profile, track: ProfileTrack
) -> tuple[FloatArray, FloatArray]:
    """Return elevation and 1-σ of the estimate in m on the profile's points; NaN if not known."""
    sigma = np.zeros(track.elevation.size) if track.sigma is None else track.sigma
    places, known = profile.distance_m, estimate.distance_m
    elevation, spread = (
        np.interp(places, known, values, left=np.nan, right=np.nan)
        for values in (track.elevation, sigma)
    )
    return elevation, spread


@dataclass(frozen=True, eq=False)
class _Gap:
    """Gaps of one wheel path and the other estimate there; arrays of shape (N,), in m."""

    profile: Profile
    track: ProfileTrack
    inside: BoolArray
    other: FloatArray
    spread: FloatArray

    def bridge(self) -> tuple[ProfileTrack, float]:
        """Return the track with its gaps filled, and the length of these in m."""
        line, misfit = self._meet()
        correction = self.other + line - self.track.elevation
        done = np.isfinite(correction)
        if not done.any():
            return self.track, 0.0
        interval_m = self.profile.interval_m
        filtered = high_pass(np.where(done, correction, 0.0), interval_m)
        sigma = self.track.sigma
        if sigma is not None:
            sigma = np.where(done, np.hypot(self.spread, misfit), sigma)
        elevation = self.track.elevation + filtered
        track = ProfileTrack.of(self.track.name, elevation, self.track.valid & ~done, sigma)
        return track, float(np.count_nonzero(done) * interval_m)

    def _meet(self) -> tuple[FloatArray, FloatArray]:
        """Return the line to add to the other estimate in each gap, and its 1-σ; NaN elsewhere."""
        off = np.where(self.inside, np.nan, self.track.elevation - self.other)
        line, misfit = np.full(off.size, np.nan), np.full(off.size, np.nan)
        beside = max(1, round(MEETING_M / self.profile.interval_m))
        edges = np.flatnonzero(np.diff(self.inside, prepend=False, append=False))
        for begin, end in edges.reshape(-1, 2).tolist():
            sides = slice(max(begin - beside, 0), begin), slice(end, end + beside)
            met = [(side, off[side]) for side in sides if _enough(off[side], beside)]
            if met:
                places = [(side.start + side.stop - 1) / 2 for side, _ in met]
                means = [float(np.nanmean(values)) for _, values in met]
                line[begin:end] = np.interp(np.arange(begin, end), places, means)
                misfit[begin:end] = max(float(np.nanstd(values)) for _, values in met)
        return line, misfit


def _enough(values: FloatArray, beside: int) -> bool:
    return bool(np.count_nonzero(np.isfinite(values)) >= FEWEST * beside)
