"""What the adapter finds in a log of CAN frames, and logs that python-can writes."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import can

from floatref import NativeFile
from floatref_adapters.formats.can_log.adapter import CanLog
from floatref_adapters.formats.csv_table.adapter import CsvTable
from floatref_adapters.testing.can_log import WHEELS_DBC, WHEELS_ID


def opened(
    folder: Path, content: bytes | str, name: str = "run.asc", dbc: str | None = WHEELS_DBC
) -> NativeFile:
    """Return what the adapter finds in a log that holds ``content``, with the database ``dbc``."""
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    options: Mapping[str, str] = {}
    if dbc is not None:
        (folder / "bus.dbc").write_text(dbc)
        options = {"dbc": str(folder / "bus.dbc")}
    assert CanLog().recognises(path)
    assert not CsvTable().recognises(path)
    return CanLog().streams(path, options)


def logged(path: Path, data: Iterable[bytes]) -> bytes:
    """Return the log that python-can writes of ``data`` to ``path``, in the form of its suffix."""
    with can.Logger(str(path)) as log:
        for k, content in enumerate(data):
            log.on_message_received(
                can.Message(
                    timestamp=1_704_067_200 + k / 64,
                    arbitration_id=WHEELS_ID,
                    is_extended_id=False,
                    data=content,
                    channel=0,
                )
            )
    return path.read_bytes()
