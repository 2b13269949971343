"""MCAP, which PlotJuggler and Foxglove open: recordings of floatref, out and in."""

from pathlib import Path

from floatref import Recording, read_start
from floatref_adapters.formats.mcap_log.mcap_reading import read_mcap
from floatref_adapters.formats.mcap_log.mcap_writing import write_mcap
from floatref_adapters.shared.refusals import library

MAGIC = b"\x89MCAP0\r\n"


class Mcap:
    """The adapter and the format of such files: a topic for each clock, messages of protobuf."""

    name = "mcap"
    suffix = ".mcap"
    summary = "MCAP (.mcap) that floatref wrote: a topic per clock, messages of protobuf"

    def check_installed(self) -> None:
        """Raise InputError where mcap or protobuf is missing."""
        library("mcap.writer", "writing MCAP")
        library("google.protobuf", "writing MCAP")

    def recognises(self, source: Path) -> bool:
        """Tell from its first bytes whether ``source`` is an MCAP file."""
        return read_start(source, len(MAGIC)) == MAGIC

    def read(self, source: Path) -> Recording:
        """Return the recording in ``source``; InputError if it cannot be used."""
        return read_mcap(source)

    def write(self, recording: Recording, path: Path) -> None:
        """Write ``recording`` to ``path``; InputError if it cannot be held."""
        write_mcap(recording, path)
