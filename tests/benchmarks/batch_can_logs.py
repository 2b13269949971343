"""A recording as a CAN log of any format that python-can writes, its database and its map."""

from collections.abc import Iterator
from pathlib import Path

import can
import numpy as np

from floatref import Channel, Recording
from floatref_adapters.testing.can_log import ANY_NODE

STEPS = {
    "height": ("mm", 1e-3, 1e-6),
    "vertical_specific_force": ("m/s^2", 1.0, 1e-6),
    "distance": ("m", 1.0, 1e-4),
    "gnss_latitude": ("deg", np.pi / 180, 1e-7),
    "gnss_longitude": ("deg", np.pi / 180, 1e-7),
}
"""By channel: unit, what it is in SI, and the resolution in SI."""
DATABASE, CHART = "bus.dbc", "can.toml"
FIRST_ID = 0x100
PAIRS = (("height", "vertical_specific_force"), ("distance",), ("gnss_latitude", "gnss_longitude"))
CAN_FORMATS = (".asc", ".blf", ".log", ".trc")
"""By the suffix that python-can knows: Vector ASC and BLF, candump, and PEAK TRC."""


def messages(recording: Recording) -> dict[str, list[Channel]]:
    """Return up to two channels for each message: those of a wheel path, distance, position."""
    found: dict[str, list[Channel]] = {}
    for channel in recording.channels:
        kind = next(k for k, pair in enumerate(PAIRS) if channel.id.name in pair)
        found.setdefault(f"M{kind}_{channel.id.track or 'all'}", []).append(channel)
    return found


def quantum(channel: Channel) -> float:
    """Return the step of ``channel`` in the unit of the database."""
    _, unit, step = STEPS[channel.id.name]
    return step if unit != 1e-3 else step / unit


def database(recording: Recording) -> str:
    """Return a DBC of signals of 32 bits with sign."""
    lines = ['VERSION ""', "NS_ :", "BS_:", "BU_: Logger"]
    for k, (name, channels) in enumerate(messages(recording).items()):
        lines += ["", f"BO_ {FIRST_ID + k} {name}: 8 Logger"]
        for place, channel in enumerate(channels):
            unit = STEPS[channel.id.name][0]
            spot = f"{32 * place}|32@1- ({quantum(channel):.0e},0) [0|0]"
            lines.append(f' SG_ {signal(channel)} : {spot} "{unit}" {ANY_NODE}')
    return "\n".join(lines) + "\n"


def signal(channel: Channel) -> str:
    """Return the name of ``channel`` in the database."""
    return str(channel.id).replace(".", "_")


def chart(recording: Recording) -> str:
    lines = ['format = "floatref-map/1"', "[source]", f'dbc = "{DATABASE}"']
    lines += ["[setup]", f"profile_interval_m = {recording.setup.profile_interval_m}"]
    for channel in recording.channels:
        track = [f'track = "{channel.id.track}"'] if channel.id.track else []
        named = [f'native = "{signal(channel)}"', f'channel = "{channel.id.name}"']
        lines += ["[[channels]]", *named, *track]
    return "\n".join(lines) + "\n"


def frames(recording: Recording) -> Iterator[can.Message]:
    """Yield what the bus carries, in the order of time."""
    found = []
    for k, channels in enumerate(messages(recording).values()):
        counts = [np.rint(c.values / find_unit(c) / quantum(c)).astype("<i4") for c in channels]
        data = np.stack([*counts, np.zeros_like(counts[0])][:2], axis=1)
        times = channels[0].clock.times(len(data))
        found += [(t, FIRST_ID + k, row.tobytes()) for t, row in zip(times, data, strict=True)]
    for time, number, content in sorted(found):
        yield can.Message(
            timestamp=time + 1.0, arbitration_id=number, data=content, is_extended_id=False
        )


def find_unit(channel: Channel) -> float:
    """Return what the unit of the database is in SI."""
    return STEPS[channel.id.name][1]


def write_can_log(recording: Recording, path: Path, quanta: object = None) -> None:
    """Write ``recording`` to ``path``, whose suffix tells the format."""
    with can.Logger(str(path)) as log:
        for message in frames(recording):
            log(message)


def write_database(recording: Recording, folder: Path) -> None:
    """Write the database and the map of all logs in ``folder`` with the channels of this one."""
    (folder / DATABASE).write_text(database(recording))
    (folder / CHART).write_text(chart(recording))
