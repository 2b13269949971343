"""Lines of a text log of any size: whatever ends them, and however long they are."""

from collections.abc import Iterator
from pathlib import Path

from floatref import InputError, open_bytes

BLOCK = 1 << 20
"""Bytes read together."""
LONGEST = 1 << 16
"""Bytes of a line without an end that are kept until its end comes."""
MARK = b"\xef\xbb\xbf"


def text_lines(source: Path) -> Iterator[bytes]:
    """Yield the lines of ``source`` that hold anything, without their CR, LF or CR LF.

    A byte-order mark is left out. A line longer than `LONGEST` bytes may come in pieces. Raises
    InputError if ``source`` cannot be read.
    """
    for line in _lines(source):
        if line:
            yield line


def _lines(source: Path) -> Iterator[bytes]:
    rest = b""
    for number, block in enumerate(blocks(source)):
        piece = rest + (block.removeprefix(MARK) if number == 0 else block)
        cut = max(piece.rfind(b"\n"), piece.rfind(b"\r")) + 1
        yield from piece[:cut].splitlines()
        rest = piece[cut:]
        if len(rest) > LONGEST:
            yield rest
            rest = b""
    yield rest


def blocks(source: Path) -> Iterator[bytes]:
    """Yield the bytes of ``source`` in blocks; InputError if it cannot be read."""
    if source.is_dir():
        raise InputError(f"{source}: a folder; give a file")
    with open_bytes(source) as stream:
        while block := stream.read(BLOCK):
            yield block
