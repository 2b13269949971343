"""Fixes written as NMEA 0183: GGA, RMC, VTG and GST of every epoch."""

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta

from floatref_adapters.testing.fixes import Fixes

UNIX = datetime(1970, 1, 1, tzinfo=UTC)
KNOT_M_S = 1852 / 3600
ANGLE_QUANTUM_DEG = 1e-7 / 60
HEIGHT_QUANTUM_M = 1e-4
SPEED_QUANTUM_KMH = 1e-3


def nmea_log(fixes: Fixes, talker: str = "GN", ending: str = "\r\n") -> bytes:
    """Return ``fixes``, whose ms are since 1970 UTC, as sentences with checksums."""
    sentences = (s for k in range(len(fixes.ms)) for s in _epoch(fixes, k, talker))
    return "".join(f"{sentence}{ending}" for sentence in sentences).encode("ascii")


def sentence(body: str) -> str:
    """Return the sentence with its `$` and its checksum."""
    checksum = 0
    for character in body.encode("ascii"):
        checksum ^= character
    return f"${body}*{checksum:02X}"


def _epoch(fixes: Fixes, k: int, talker: str) -> Iterator[str]:
    when = UNIX + timedelta(milliseconds=fixes.ms[k])
    time = f"{when:%H%M%S}.{when.microsecond // 1000:03d}"
    place = f"{_angle(fixes.latitude_deg[k], 2, 'NS')},{_angle(fixes.longitude_deg[k], 3, 'EW')}"
    heights = f"{fixes.altitude_m[k]:.4f},M,{fixes.separation_m[k]:.4f},M"
    speed, course = fixes.speed_m_s[k], fixes.course_deg[k]
    motion = f"{speed / KNOT_M_S:.4f},{course:.3f}"
    kmh = f"{speed * 3.6:.3f}"
    yield sentence(f"{talker}GGA,{time},{place},{fixes.quality[k]},12,0.8,{heights},1.0,0042")
    yield sentence(f"{talker}RMC,{time},A,{place},{motion},{when:%d%m%y},,,A")
    yield sentence(f"{talker}VTG,{course:.3f},T,,M,{speed / KNOT_M_S:.4f},N,{kmh},K,A")
    yield sentence(f"{talker}GST,{time},0.9,0.02,0.01,45.0,0.011,0.012,0.023")


def _angle(value: float, digits: int, sides: str) -> str:
    minutes = round(abs(value) * 60 * 10**7)
    degrees, rest = divmod(minutes, 60 * 10**7)
    whole, decimals = divmod(rest, 10**7)
    return f"{degrees:0{digits}d}{whole:02d}.{decimals:07d},{sides[value < 0]}"


__all__ = [
    "ANGLE_QUANTUM_DEG",
    "HEIGHT_QUANTUM_M",
    "SPEED_QUANTUM_KMH",
    "nmea_log",
    "sentence",
]
