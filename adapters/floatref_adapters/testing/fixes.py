"""Fixes of a GNSS receiver, to be written in the formats of receivers."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Fixes:
    """Successive fixes: ``ms`` since the zero of the format's clock, deg, m, m/s.

    ``altitude_m`` is above the geoid, ``separation_m`` the geoid above the ellipsoid, ``quality``
    that of NMEA GGA, ``course_deg`` from true north.
    """

    ms: Sequence[int]
    latitude_deg: Sequence[float]
    longitude_deg: Sequence[float]
    altitude_m: Sequence[float]
    separation_m: Sequence[float]
    quality: Sequence[int]
    speed_m_s: Sequence[float]
    course_deg: Sequence[float]
    up_m_s: Sequence[float]


__all__ = ["Fixes"]
