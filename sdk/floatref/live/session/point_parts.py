"""Points that are read again from the disk: in parts, each of which is one answer."""

from collections.abc import Iterator

from floatref.values.profile import Profile, ProfileTrack

AT_ONCE = 20_000
"""Points in a part."""


def parts(first: int | None, begin: int, end: int) -> Iterator[tuple[int, int]]:
    """Yield the ends of short parts of the points from ``first`` on; nothing for None.

    There are points from ``begin`` to before ``end``.
    """
    if first is not None:
        for low in range(max(first, begin), end, AT_ONCE):
            yield low, min(low + AT_ONCE, end)


def cut_tracks(profile: Profile, low: int, high: int) -> tuple[ProfileTrack, ...]:
    """Return points ``low`` to ``high`` - 1 of every wheel path of ``profile``."""
    cut = slice(low, high)
    return tuple(
        ProfileTrack.of(
            track.name,
            track.elevation[cut],
            track.valid[cut],
            None if track.sigma is None else track.sigma[cut],
        )
        for track in profile.tracks
    )
