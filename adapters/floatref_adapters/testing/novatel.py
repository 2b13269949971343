"""Fixes written as logs of a NovAtel receiver: BESTPOS and BESTVEL, ASCII or binary."""

import struct
from collections.abc import Iterator

from floatref_adapters.formats.novatel.log_frames import LONG_HEADER, SHORT_HEADER, WEEK_MS, crc32
from floatref_adapters.testing.fixes import Fixes

SYNC, SHORT_SYNC = b"\xaaD\x12", b"\xaaD\x13"
BESTPOS, BESTVEL = 42, 99
DEFINITIONS = {BESTPOS: 0xB1F6, BESTVEL: 0x10A2}
FINESTEERING = 180
KINDS = {0: (0, "NONE"), 1: (16, "SINGLE"), 2: (17, "PSRDIFF"), 4: (50, "NARROW_INT")}
KINDS[5] = (34, "NARROW_FLOAT")
POSITION = struct.Struct("<IIdddfIfff4sffBBBBBBBB")
VELOCITY = struct.Struct("<IIffdddf")


def ascii_log(fixes: Fixes, ending: bytes = b"\r\n") -> bytes:
    """Return ``fixes``, whose ms are of GPS time, as BESTPOSA and BESTVELA."""
    return b"".join(line + ending for k in range(len(fixes.ms)) for line in _lines(fixes, k))


def binary_log(fixes: Fixes) -> bytes:
    """Return ``fixes``, whose ms are of GPS time, as BESTPOSB and BESTVELB."""
    return b"".join(log for k in range(len(fixes.ms)) for log in _logs(fixes, k))


def long_log(
    number: int, gps_ms: int, body: bytes, status: int = FINESTEERING, kind: int = 0
) -> bytes:
    """Return a binary log with the long header; ``kind`` has antenna, format and answer in bits."""
    week, ms = divmod(gps_ms, WEEK_MS)
    definition = DEFINITIONS.get(number, 0)
    header = LONG_HEADER.pack(
        SYNC,
        LONG_HEADER.size,
        number,
        kind,
        32,
        len(body),
        0,
        90,
        status,
        week,
        ms,
        0,
        definition,
        0,
    )
    return _add_checksum(header + body)


def short_log(number: int, gps_ms: int, body: bytes) -> bytes:
    """Return a binary log with the short header."""
    return _add_checksum(
        SHORT_HEADER.pack(SHORT_SYNC, len(body), number, *divmod(gps_ms, WEEK_MS)) + body
    )


def text_log(name: str, gps_ms: int, definition: int, fields: str, status: str) -> bytes:
    """Return an ASCII log with the long header, without the end of its line."""
    week, ms = divmod(gps_ms, WEEK_MS)
    head = f"{name},COM1,0,85.0,{status},{week},{ms // 1000}.{ms % 1000:03d},00000000"
    body = f"{head},{definition:04x},0;{fields}".encode("ascii")
    return b"#%s*%08x" % (body, crc32(body))


def _add_checksum(log: bytes) -> bytes:
    return log + struct.pack("<I", crc32(log))


def _lines(fixes: Fixes, k: int) -> Iterator[bytes]:
    status = "SOL_COMPUTED" if fixes.quality[k] else "INSUFFICIENT_OBS"
    solution = f"{status},{KINDS[fixes.quality[k]][1]}"
    place = f"{fixes.latitude_deg[k]:.11f},{fixes.longitude_deg[k]:.11f}"
    heights = f"{fixes.altitude_m[k]:.4f},{fixes.separation_m[k]:.4f}"
    rest = 'WGS84,0.0100,0.0100,0.0200,"0",1.000,0.000,20,18,18,18,0,00,00,11'
    position = f"{solution},{place},{heights},{rest}"
    motion = f"{fixes.speed_m_s[k]:.4f},{fixes.course_deg[k]:.6f},{fixes.up_m_s[k]:.4f}"
    velocity = f"{solution},0.150,1.000,{motion},0.0"
    for name, number, fields in (("BESTPOSA", 42, position), ("BESTVELA", 99, velocity)):
        yield text_log(name, fixes.ms[k], DEFINITIONS[number], fields, "FINESTEERING")


def _logs(fixes: Fixes, k: int) -> Iterator[bytes]:
    solution = 0 if fixes.quality[k] else 1, KINDS[fixes.quality[k]][0]
    place = fixes.latitude_deg[k], fixes.longitude_deg[k], fixes.altitude_m[k]
    rest = 61, 0.01, 0.01, 0.02, b"0", 1.0, 0.0, 20, 18, 18, 18, 0, 0, 0, 17
    motion = fixes.speed_m_s[k], fixes.course_deg[k], fixes.up_m_s[k]
    position = POSITION.pack(*solution, *place, fixes.separation_m[k], *rest)
    yield long_log(BESTPOS, fixes.ms[k], position)
    yield long_log(BESTVEL, fixes.ms[k], VELOCITY.pack(*solution, 0.15, 1.0, *motion, 0.0))


__all__ = ["ascii_log", "binary_log", "long_log", "short_log", "text_log"]
