"""Wheel speeds written as CAN logs, ASC and candump, with the database that tells them."""

from collections.abc import Sequence

WHEELS_ID = 0x4B0
QUANTUM_KMH = 0.01
WHEELS = ("FrontLeft", "FrontRight", "RearLeft", "RearRight")
ANY_NODE = "Vector__XXX"
"""The name that the DBC format gives to a receiver that is not a node listed in the file."""
WHEELS_DBC = f"""VERSION ""

NS_ :

BS_:

BU_: Brakes

BO_ 1200 WheelSpeeds: 8 Brakes
 SG_ FrontLeft : 0|16@1+ (0.01,0) [0|655.35] "km/h" {ANY_NODE}
 SG_ FrontRight : 16|16@1+ (0.01,0) [0|655.35] "km/h" {ANY_NODE}
 SG_ RearLeft : 39|16@0+ (0.01,0) [0|655.35] "km/h" {ANY_NODE}
 SG_ RearRight : 55|16@0+ (0.01,0) [0|655.35] "km/h" {ANY_NODE}

BO_ 2566834709 Multiplexed: 4 Brakes
 SG_ Kind M : 0|8@1+ (1,0) [0|255] "" {ANY_NODE}
 SG_ Pressure m0 : 8|16@1- (0.5,-40) [0|0] "bar" {ANY_NODE}
 SG_ Temperature m1 : 8|16@1- (0.1,0) [0|0] "degC" {ANY_NODE}

BO_ 1210 Fast: 16 Brakes
 SG_ Last : 120|8@1+ (1,0) [0|255] "" {ANY_NODE}

CM_ SG_ 1200 FrontLeft "of the front axle, left";
"""
"""Two wheels have the low byte first, two the high one."""
MULTIPLEXED_ID = 2566834709 & 0x1FFFFFFF
FAST_ID = 1210


def wheels_data(counts: Sequence[int]) -> bytes:
    """Return the data of a frame of four wheel speeds, each in counts of `QUANTUM_KMH`."""
    little = b"".join(count.to_bytes(2, "little") for count in counts[:2])
    return little + b"".join(count.to_bytes(2, "big") for count in counts[2:])


Frames = Sequence[tuple[int, int, bytes]]
"""Time in us, id (above 0x7FF an extended one), data."""


def asc_log(frames: Frames, base: str = "hex", channel: int = 1, relative: bool = False) -> str:
    """Return ``frames`` as a Vector ASC log with LF line ends."""
    kind = "relative" if relative else "absolute"
    lines = ["date Tue May 27 04:09:35.000 pm 2014", f"base {base}  timestamps {kind}"]
    lines += ["internal events logged", "// version 10.0.1"]
    last = 0
    for time, number, data in frames:
        shown = time - last if relative else time
        last = time
        lines.append(_asc_line(shown, number, data, base, channel))
    return "\n".join(lines) + "\n"


def _asc_line(time: int, number: int, data: bytes, base: str, channel: int) -> str:
    form = "X" if base == "hex" else "d"
    name = f"{number:{form}}{'x' if number > 0x7FF else ''}"
    when = f"{time // 10**6:4d}.{time % 10**6:06d}"
    if len(data) > 8:
        code = {12: "9", 16: "a", 20: "b", 24: "c", 32: "d", 48: "e", 64: "f"}[len(data)]
        content = " ".join(f"{byte:02x}" for byte in data)
        return f"{when} CANFD {channel:3d} Rx {name:>11} {'':>33} 1 0 {code} {len(data)} {content}"
    content = " ".join(f"{byte:{form}}" for byte in data)
    return f"{when} {channel}  {name:<15} Rx   d {len(data)} {content}"


def candump_log(frames: Frames, bus: str = "can0") -> str:
    """Return ``frames`` as `candump -l` writes them."""
    lines = []
    for time, number, data in frames:
        name = f"{number:08X}" if number > 0x7FF else f"{number:03X}"
        flags = "#1" if len(data) > 8 else ""
        lines.append(
            f"({time // 10**6}.{time % 10**6:06d}) {bus} {name}#{flags}{data.hex().upper()}"
        )
    return "\n".join(lines) + "\n"


__all__ = [
    "FAST_ID",
    "MULTIPLEXED_ID",
    "QUANTUM_KMH",
    "WHEELS",
    "WHEELS_DBC",
    "WHEELS_ID",
    "asc_log",
    "candump_log",
    "wheels_data",
]
