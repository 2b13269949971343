"""The IRI of a profile's wheel paths, with the share of the road that each figure is about."""

from collections.abc import Iterator
from dataclasses import dataclass

from floatref.errors import InputError
from floatref.values.display.html_table import html_table
from floatref.values.display.short_text import NO_VALUE, join_some, percent, shorten
from floatref.values.display.similar_names import hint_at

COLUMNS = ("wheel path", "IRI of valid points (m/km)", "share that counts", "all points (m/km)")


@dataclass(frozen=True)
class TrackIri:
    """The IRI of one wheel path, in m/km.

    Attributes:
        track: the name of the wheel path.
        valid_m_per_km: the mean over the stretches of valid points; NaN if all are too short.
        counted_share: the share of all intervals that this mean is over, 0 to 1.
        all_m_per_km: the mean over every interval, invalid ones included; NaN without enough.
    """

    track: str
    valid_m_per_km: float
    counted_share: float
    all_m_per_km: float

    @property
    def cells(self) -> tuple[str, str, str, str]:
        """The four figures as text, in the order of `COLUMNS`."""
        valid, every = _number(self.valid_m_per_km), _number(self.all_m_per_km)
        return shorten(self.track), valid, percent(self.counted_share), every

    def __str__(self) -> str:
        """Return the figures on one line."""
        name, valid, share, every = self.cells
        return f"{name} {valid} m/km over {share} (all points: {every})"


@dataclass(frozen=True, repr=False)
class ProfileIri:
    """The IRI of every wheel path of a profile, in the order of its tracks."""

    tracks: tuple[TrackIri, ...]

    def __getitem__(self, name: str) -> TrackIri:
        """Return the figures of wheel path ``name``; InputError if it is missing."""
        for found in self.tracks:
            if found.track == name:
                return found
        here = [found.track for found in self.tracks]
        raise InputError(
            f"track {name}: missing; there is an IRI of {', '.join(here)}{hint_at(name, here)}"
        )

    def __iter__(self) -> Iterator[TrackIri]:
        """Go through the wheel paths."""
        return iter(self.tracks)

    def __repr__(self) -> str:
        """Return all figures on one line."""
        return f"ProfileIri({join_some([str(found) for found in self.tracks])})"

    def _repr_html_(self) -> str:
        return html_table("IRI", COLUMNS, [found.cells for found in self.tracks])


def _number(m_per_km: float) -> str:
    return f"{m_per_km:.3f}" if m_per_km == m_per_km else NO_VALUE
