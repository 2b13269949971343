"""A part of a profile, by distance, and of a recording, by time."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.display.similar_names import hint_at
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording

SLACK = 1e-6
"""Part of an interval by which a limit may miss a point and still include it."""


@dataclass(frozen=True)
class Window:
    """What lies between two limits, both included: in m for a profile, in s for a recording.

    None is the first or the last point there is. The seconds of a recording count from the first
    sample of any channel.
    """

    begin: float | None = None
    end: float | None = None

    def __post_init__(self) -> None:
        """Refuse limits that are not numbers, or in the wrong order."""
        for name, value in (("from", self.begin), ("to", self.end)):
            if value is not None and not np.isfinite(value):
                raise InputError(f"{name} {value}: not a number; give one")
        if self.begin is not None and self.end is not None and self.begin >= self.end:
            raise InputError(f"{self}: ends before it begins; exchange the two")

    def __str__(self) -> str:
        """Return the limits as text."""
        begin = "" if self.begin is None else f"from {self.begin:.10g}"
        end = "" if self.end is None else f"to {self.end:.10g}"
        return f"{begin} {end}".strip()

    @property
    def is_whole(self) -> bool:
        """Whether it has no limits."""
        return self.begin is None and self.end is None


def points_of(profile: Profile, window: Window) -> slice:
    """Return the points of ``profile`` in ``window``; InputError for fewer than two."""
    count = profile.tracks[0].elevation.size
    index = [
        None if limit is None else (limit - profile.start_m) / profile.interval_m
        for limit in (window.begin, window.end)
    ]
    first = 0 if index[0] is None else max(0, int(np.ceil(index[0] - SLACK)))
    end = count if index[1] is None else min(count, int(np.floor(index[1] + SLACK)) + 1)
    if end - first < 2:
        last_m = profile.start_m + profile.length_m
        raise InputError(
            f"{window}: holds fewer than two points; "
            f"the profile goes from {profile.start_m:.10g} to {last_m:.10g} m"
        )
    return slice(first, end)


def cut_profile(profile: Profile, window: Window) -> Profile:
    """Return the part of ``profile`` in ``window``; InputError for fewer than two points."""
    part = points_of(profile, window)
    tracks = tuple(_cut_track(track, part) for track in profile.tracks)
    start_m = profile.start_m + part.start * profile.interval_m
    return replace(profile, tracks=tracks, start_m=start_m)


def first_time(recording: Recording) -> float:
    """Return the time in s of the first sample of any channel."""
    return min(channel.span_s[0] for channel in recording.channels)


def choose_channels(recording: Recording, names: Sequence[str]) -> tuple[Channel, ...]:
    """Return the channels with these names, such as "height" or "left.height"; all without names.

    Raises InputError for a name that no channel has.
    """
    known = {name: None for c in recording.channels for name in (c.id.name, str(c.id))}
    for name in names:
        if name not in known:
            here = ", ".join(str(channel.id) for channel in recording.channels)
            raise InputError(
                f"channel {name}: missing{hint_at(name, known)}; the recording holds {here}"
            )
    return tuple(c for c in recording.channels if not names or {c.id.name, str(c.id)} & set(names))


def cut_recording(recording: Recording, window: Window, origin_s: float) -> Recording:
    """Return the part of ``recording`` in ``window``, whose seconds count from ``origin_s``.

    A channel without a sample there is left out. Raises InputError if every channel is.
    """
    if window.is_whole:
        return recording
    found = tuple(_cut_channels(recording, window, origin_s))
    if not found:
        raise InputError(
            f"{window}: holds no sample; the recording lasts {recording.duration_s:.10g} s"
        )
    return replace(recording, channels=found)


def _cut_channels(recording: Recording, window: Window, origin_s: float) -> Iterator[Channel]:
    stamped: dict[tuple[int, int, int], StampedClock] = {}
    for channel in recording.channels:
        part = _samples_of(channel, window, origin_s)
        if part.stop <= part.start:
            continue
        clock = channel.clock
        if isinstance(clock, UniformClock):
            cut = UniformClock(clock.rate, float(clock.times(1, part.start)[0]))
            yield Channel(channel.id, channel.values[part], cut)
        else:
            # Channels on one clock stay on one.
            key = id(clock), part.start, part.stop
            shared = stamped.setdefault(key, StampedClock(clock.times_s[part]))
            yield Channel(channel.id, channel.values[part], shared)


def _samples_of(channel: Channel, window: Window, origin_s: float) -> slice:
    """Return the samples of ``channel`` in ``window``."""
    count, clock = channel.values.size, channel.clock
    limits = [None if x is None else origin_s + x for x in (window.begin, window.end)]
    if isinstance(clock, StampedClock):
        times = clock.times_s
        first = 0 if limits[0] is None else int(np.searchsorted(times, limits[0]))
        end = count if limits[1] is None else int(np.searchsorted(times, limits[1], "right"))
        return slice(first, end)
    index = [None if x is None else (x - clock.start_s) * float(clock.rate) for x in limits]
    first = 0 if index[0] is None else max(0, int(np.ceil(index[0] - SLACK)))
    end = count if index[1] is None else min(count, int(np.floor(index[1] + SLACK)) + 1)
    return slice(first, end)


def _cut_track(track: ProfileTrack, part: slice) -> ProfileTrack:
    sigma = None if track.sigma is None else track.sigma[part]
    return ProfileTrack(track.name, track.elevation[part], track.valid[part], sigma)
