"""The text of a table in pieces: whole lines that end in LF, whatever the file's encoding."""

import codecs
from collections.abc import Callable, Iterator
from pathlib import Path

from floatref import InputError, open_bytes

BLOCK = 1 << 20
"""Bytes read together."""
SAMPLE, LARGEST_SAMPLE = 1 << 16, 1 << 20
"""Bytes from which the layout is found, and up to how many where lines are long."""
FEWEST_LINES = 20
LONGEST_LINE = 1 << 24
WHITE = b" \t\r\n\f\v"

Block = tuple[int, bytes]
"""Number of the first line, and lines."""


def find_encoding(start: bytes) -> str:
    """Return the encoding of a text that begins with ``start``; InputError if not text.

    Without a byte-order mark it is UTF-8, and Latin-1 where it cannot be that.
    """
    if start.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    if b"\0" in start:
        raise InputError("not a text file; export it as CSV in UTF-8")
    if start.startswith(codecs.BOM_UTF8):
        return "utf-8-sig"
    try:
        codecs.getincrementaldecoder("utf-8")().decode(start)
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"


def read_sample(path: Path) -> tuple[str, list[str]]:
    """Return the encoding of the file and its first lines, without ends, the last one whole."""
    with open_bytes(path) as stream:
        start = stream.read(SAMPLE)
        while len(start) < LARGEST_SAMPLE and _ends(start) < FEWEST_LINES:
            more = stream.read(SAMPLE)
            if not more:
                break
            start += more
        whole = not stream.read(1)
    encoding = find_encoding(start)
    text = codecs.getincrementaldecoder(encoding)("replace").decode(start)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if not whole and len(lines) > 1:
        lines.pop()
    return encoding, lines


def _ends(text: bytes) -> int:
    return max(text.count(b"\n"), text.count(b"\r"))


def blocks(path: Path, encoding: str, delimiter: str) -> Iterator[Block]:
    """Yield the lines of the file in pieces; a last line without an end comes alone.

    Every piece but such a line ends in LF. Lines at the end of the file that hold nothing but
    spaces and the ``delimiter``, as spreadsheets leave them, are left out. InputError for a line
    of more than 16 MiB.
    """
    line, rest, nothing = 1, b"", WHITE + delimiter.encode()
    with open_bytes(path) as stream:
        for text in _unix(stream.read, encoding):
            body, rest = _whole_lines(rest + text, nothing)
            if len(rest) > LONGEST_LINE:
                number = line + body.count(b"\n")
                raise InputError(f"row {number}: no line end in 16 MB; this is no table")
            if body:
                yield line, body
                line += body.count(b"\n")
    if rest.strip(nothing):
        yield line, rest


def _whole_lines(text: bytes, nothing: bytes) -> tuple[bytes, bytes]:
    """Return the lines of ``text``, and what may be empty lines at the end of the file."""
    cut = text.rfind(b"\n") + 1
    filled = len(text[:cut].rstrip(nothing))
    cut = text.find(b"\n", filled, cut) + 1
    return text[:cut], text[cut:]


def _unix(read: Callable[[int], bytes], encoding: str) -> Iterator[bytes]:
    """Yield UTF-8, or Latin-1 as it is, with lines that end in LF."""
    decoder = codecs.getincrementaldecoder("utf-16")("replace") if encoding == "utf-16" else None
    held, first = b"", encoding == "utf-8-sig"
    while raw := read(BLOCK):
        text = decoder.decode(raw).encode("utf-8", "replace") if decoder else raw
        text = held + (text.removeprefix(codecs.BOM_UTF8) if first else text)
        first = False
        # The LF of a CR LF may be the next byte.
        held = text[-1:] if text.endswith(b"\r") else b""
        text = text[: len(text) - len(held)]
        if b"\r" in text:
            text = text.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
        yield text
    if held:
        yield b"\n"
