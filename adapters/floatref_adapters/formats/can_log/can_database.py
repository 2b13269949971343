"""Messages of a CAN database (DBC, KCD, SYM, ARXML): what the bytes of a frame say."""

import logging
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from floatref import Column, InputError, open_bytes
from floatref_adapters.shared.refusals import library

LARGEST = 1 << 26
"""Bytes of a database that is read; those of whole vehicles have a few million."""
NOTE = 120
NAN = float("nan")


class Message:
    """A message of the database: its name, its columns, and how to have their values."""

    def __init__(self, message: Any) -> None:
        self.name = str(message.name)
        self.size = int(message.length)
        self._message = message
        self.multiplexed = bool(message.is_multiplexed())
        signals = {signal.name: signal for signal in message.signals}
        sound = self.multiplexed or self.decode(bytes(self.size)) is not None
        self.columns = tuple(_column(signal) for signal in signals.values()) if sound else ()

    def decode(self, data: bytes) -> Mapping[str, Any] | None:
        """Return the values by signal, None if ``data`` is not of this message."""
        try:
            decoded = self._message.decode(data, decode_choices=False, decode_containers=False)
        except Exception:
            # Any error of cantools here means bytes that its definition cannot hold.
            return None
        return decoded if isinstance(decoded, dict) else None

    def fits(self, data: bytes) -> bool:
        """Tell whether ``data`` can be decoded."""
        if len(data) < self.size:
            return False
        return not self.multiplexed or self.decode(data) is not None

    def values(self, data: bytes, names: Sequence[str]) -> list[float]:
        """Return the values of the signals ``names``; NaN where the message now lacks one."""
        found = self.decode(data) if names else None
        return [found.get(name, NAN) for name in names] if found else [NAN] * len(names)


class Database:
    """The messages of the database at ``path``, by id.

    Raises InputError in one line if it cannot be read or cantools is not installed.
    """

    def __init__(self, path: Path) -> None:
        self._messages: dict[tuple[int, bool], Any] = {}
        for message in _load(path).messages:
            self._messages[message.frame_id, bool(message.is_extended_frame)] = message

    def message(self, number: int, extended: bool) -> Message | None:
        """Return the message with the id ``number``, None if it is not defined."""
        found = self._messages.get((number, extended))
        return None if found is None else Message(found)


def _load(path: Path) -> Any:
    cantools = library("cantools", f"{path}: reading a CAN database")
    logging.getLogger("cantools").addHandler(logging.NullHandler())
    try:
        _check_size(path)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            database = cantools.database.load_file(path, strict=False)
    except InputError:
        raise
    except Exception as error:
        # Its parsers raise whatever their text makes them stumble over.
        reason = " ".join(str(error).split())[:200]
        raise InputError(f"{path}: no CAN database that cantools reads: {reason}") from error
    if not hasattr(database, "messages"):
        raise InputError(f"{path}: a database of diagnostics, not of CAN messages; give a DBC")
    return database


def _check_size(path: Path) -> None:
    """Raise InputError unless ``path`` is a file that can be a database; cantools opens it."""
    try:
        with open_bytes(path) as stream:
            size = stream.seek(0, 2)
    except InputError as error:
        raise InputError(f"{error}; give the path of a DBC in option dbc") from error
    if size > LARGEST:
        raise InputError(f"{path}: a CAN database of more than 64 MiB; give the DBC of the bus")


def _column(signal: Any) -> Column:
    notes = [str(signal.comment)] if signal.comment else []
    if signal.choices:
        notes.append(", ".join(f"{key} {text}" for key, text in list(signal.choices.items())[:8]))
    if signal.multiplexer_signal:
        notes.append(f"while {signal.multiplexer_signal} is {signal.multiplexer_ids}")
    note = " ".join("; ".join(notes).split())
    return Column(str(signal.name), str(signal.unit or ""), note[:NOTE])
