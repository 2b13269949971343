"""The numbers of an ERD file: text behind the header, or 4-byte reals in a file beside it."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, map_bytes
from floatref_adapters.formats.erd.erd_header import REAL, TEXT, ErdHeader

Floats = NDArray[np.float64]

BLOCK = 1 << 20
"""Bytes of text taken together."""
LONGEST_NUMBER = 400
"""Characters; the longest decimal of a float64 in fixed notation has fewer."""
_DIGITS = b"0123456789+-.eEdD, \t\r\n\f\v"
_BETWEEN_DIGITS = re.compile(rb"[0-9],[0-9]")
_NO_NUMBER = re.compile(rb",[ \t]*,")
_DOS_END = b"\x1a\0"


def read_numbers(header: ErdHeader, path: Path, stream: BinaryIO, wanted: Sequence[int]) -> Floats:
    """Return the samples of the channels ``wanted``, shape (samples, channels), NaN as NaN.

    ``stream`` is the open file ``path``. Raises InputError, without the file's name, for data
    that are not valid numbers, and for another count than the header states.
    """
    if header.key == TEXT:
        stream.seek(header.data_at)
        values = _of_text(header, stream, wanted)
    elif header.key == REAL:
        values = _of_reals(header, path, wanted)
    else:
        raise InputError(
            f"KEYNUM is {header.key}; {TEXT} (text) and {REAL} (4-byte reals in a .bin file) are "
            "read, export the file as text"
        )
    if len(values) == 0:
        raise InputError("no numbers below END; copy the complete file")
    if header.samples not in (None, len(values)):
        raise InputError(
            f"second line says {header.samples} samples, but there are {len(values)} of "
            f"{len(header.channels)} channels; the file is cut short or its header is wrong"
        )
    return values


def _of_text(header: ErdHeader, stream: BinaryIO, wanted: Sequence[int]) -> Floats:
    count = len(header.channels)
    commas = _commas_separate(stream, count)
    parts, rest, done = [], np.empty(0), 0
    for block in _blocks(stream):
        try:
            numbers = _numbers(block, commas)
        except InputError as error:
            raise InputError(f"below sample {done}: {error}") from error
        rest = np.concatenate((rest, numbers))
        whole = rest.size // count * count
        parts.append(rest[:whole].reshape(-1, count)[:, wanted])
        rest, done = rest[whole:], done + whole // count
    if rest.size:
        raise InputError(
            f"the last sample has {rest.size} of {count} numbers; the file is cut short, or a "
            "number is missing"
        )
    return np.concatenate(parts) if parts else np.empty((0, len(wanted)))


def _commas_separate(stream: BinaryIO, count: int) -> bool:
    """Tell whether commas alone stand between the numbers of the first line below END."""
    start = stream.tell()
    first = stream.read(BLOCK).lstrip()
    stream.seek(start)
    line = re.split(rb"[\r\n]", first, maxsplit=1)[0]
    return count > 1 and len(line.split()) == 1


def _blocks(stream: BinaryIO) -> Iterator[bytes]:
    """Yield the text, cut between numbers."""
    rest = b""
    while block := stream.read(BLOCK):
        block = rest + block
        cut = max(block.rfind(space) for space in (b" ", b"\t", b"\r", b"\n", b",")) + 1
        rest = block[cut:]
        if len(rest) > LONGEST_NUMBER:
            raise InputError(f"{_show(rest)} is no number; give numbers as text below END")
        yield block[:cut]
    yield rest.rstrip(_DOS_END)


def _numbers(block: bytes, commas: bool) -> Floats:
    if b"," in block:
        _check_commas(block, commas)
        block = block.replace(b",", b" ")
    if b"d" in block or b"D" in block:
        block = re.sub(rb"(?<=[0-9.])[dD](?=[+-]?[0-9])", b"e", block)
    words = block.split()
    # float takes more than a number of a file: 1_000, infinity.
    if block.translate(None, _DIGITS):
        words = [_number_or_missing(word) for word in words]
    try:
        numbers = np.array([float(word) for word in words], dtype=np.float64)
    except ValueError:
        bad = next(word for word in words if not _is_number(word))
        raise InputError(
            f"{_show(bad)} is no number; export the file again, in wider fields"
        ) from None
    if np.isinf(numbers).any():
        bad = words[int(np.argmax(np.isinf(numbers)))]
        raise InputError(f"{_show(bad)} is more than float64 holds")
    return numbers


def _check_commas(block: bytes, separators: bool) -> None:
    found = _NO_NUMBER.search(block) or (not separators and _BETWEEN_DIGITS.search(block))
    if not found:
        return
    around = block[max(found.start() - 8, 0) : found.end() + 8]
    advice = "a number is missing between two commas"
    if not _NO_NUMBER.match(found[0]):
        advice = "write decimal points, not decimal commas"
    raise InputError(f"{_show(around)}: {advice}")


def _number_or_missing(word: bytes) -> bytes:
    if word.strip(b"+-").lower() == b"nan" or not word.translate(None, _DIGITS):
        return word
    raise InputError(f"{_show(word)} is no number; export the file again, in wider fields")


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _show(word: bytes) -> str:
    return repr(word[:40].decode("latin-1"))


def _of_reals(header: ErdHeader, path: Path, wanted: Sequence[int]) -> Floats:
    count = len(header.channels)
    if header.record_bytes != 4 * count:
        raise InputError(
            f"NBYTES is {header.record_bytes}, but {count} reals of 4 bytes take {4 * count}; "
            "export the file as text"
        )
    beside = _beside(path)
    size = beside.stat().st_size
    if size % (4 * count):
        raise InputError(
            f"{beside.name} has {size} bytes, no multiple of {4 * count}; it is cut short, copy it "
            "again"
        )
    if size == 0:
        return np.empty((0, len(wanted)))
    reals = map_bytes(beside).view("<f4").reshape(-1, count)
    values = np.stack([reals[:, index].astype(np.float64) for index in wanted], axis=1)
    if not (np.abs(values) < 1e6).all():
        raise InputError(
            f"{beside.name} holds numbers that are no elevations; is it in another byte order?"
        )
    return values


def _beside(path: Path) -> Path:
    """Return the file of numbers that belongs to the header ``path``."""
    for name in (f"{path.stem}.bin", f"{path.stem}.BIN", f"{path.name}.bin"):
        beside = path.with_name(name)
        if beside.is_file() and beside != path:
            return beside
    raise InputError(f"its numbers are in {path.stem}.bin, which is missing; copy both files")
