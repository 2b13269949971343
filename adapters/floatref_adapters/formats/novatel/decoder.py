"""The logs of NovAtel receivers decoded by novatel_edie, and why one cannot be."""

from pathlib import Path
from typing import Any

from floatref_adapters.formats.novatel.log_frames import WEEK_MS, Log
from floatref_adapters.formats.novatel.log_layouts import LogLayout, find_layout
from floatref_adapters.shared.refusals import library

TIMELESS = 80
"""A time status of less is no time."""
BINARY = 0xAA
PADDING = bytes(64)
"""Behind a binary log, so that the decoder cannot read beyond it."""


class Decoder:
    """The decoder of novatel_edie, which gets sound logs of the right size only.

    It reads beyond the end of any other one. InputError if it is not installed.
    """

    def __init__(self, source: Path) -> None:
        novatel_edie = library("novatel_edie", f"{source}: reading NovAtel logs")
        oem = library("novatel_edie.oem", f"{source}: reading NovAtel logs")
        novatel_edie.disable_internal_logging()
        self._database = oem.get_builtin_database()
        self._decode = oem.Decoder(self._database).decode
        self._trouble = novatel_edie.NovatelEdieException
        self._definitions: dict[str | int, Any] = {}
        self._layouts: dict[tuple[str | int, int | None], LogLayout] = {}

    def name_of(self, log: Log) -> str:
        """Return the name of ``log``, or its number if it is not in the list of logs."""
        definition = self._definition(log.key)
        return str(log.key) if definition is None else str(definition.name)

    def find_layout(self, log: Log) -> LogLayout:
        """Return the columns of ``log``."""
        key = (log.key, log.definition)
        if key not in self._layouts:
            self._layouts[key] = find_layout(self._definition(log.key), log.definition)
        return self._layouts[key]

    def fault_of(self, log: Log) -> str | None:
        """Return why ``log`` cannot be used, None if it can."""
        if self._definition(log.key) is None:
            return "unknown"
        if _timeless(log):
            return "timeless"
        layout = self.find_layout(log)
        if not layout.columns:
            return "lists"
        if log.room < (layout.size if log.binary else layout.fields):
            return "unfit"
        # A binary log of the right size always decodes; text may hold anything.
        return None if log.binary or self._holds(log.content) else "unfit"

    def decode(self, content: bytes) -> Any:
        """Return the decoded log; ``content`` has no fault."""
        return self._decode(content + PADDING if content[0] == BINARY else content)

    def _holds(self, content: bytes) -> bool:
        try:
            return hasattr(self._decode(content), "get_field_names")
        except (self._trouble, RuntimeError, ValueError):
            return False

    def _definition(self, key: str | int) -> Any:
        if key not in self._definitions:
            self._definitions[key] = self._database.get_msg_def(key)
        return self._definitions[key]


def _timeless(log: Log) -> bool:
    """Tell whether the receiver did not know the time; short headers have no status of it."""
    return log.gps_ms < WEEK_MS if log.time_status is None else log.time_status < TIMELESS
