"""The pages of a Parquet file, looked at before pyarrow unpacks them.

pyarrow takes the memory that the header of a page declares, and a header is a few bytes: eight
wrong ones are gigabytes. So the sizes of every page are compared with those of its column chunk in
the footer, and with the bytes that it has in the file.
"""

from collections.abc import Iterable, Iterator
from typing import BinaryIO, NamedTuple

from floatref import InputError
from floatref_adapters.formats.arrow.thrift_compact import Compact, Fields

ALWAYS = 1 << 26
"""Bytes that a page may have in memory, however small it is in the file; writers use 1 MiB."""
LARGEST_RATIO = 100
"""Most bytes in memory of a larger page for each of its bytes in the file."""
HEADERS = (1 << 12, 1 << 20)
"""Bytes within which a header ends, and those within which it ends if it has long texts."""
SIZE, STORED, VALUES = 2, 3, 1
"""Fields of a header: its sizes in memory and in the file; of the struct in it, its values."""
KINDS = (5, 7, 8)
"""Fields of the structs of data pages, dictionaries and data pages of version 2."""
GROUPS, COLUMNS, META, ENCRYPTED, PATH = 4, 1, 3, 8, 3
"""Fields of the footer: its row groups, their columns, what one is, its key, its path."""
COUNT, UNPACKED, PACKED, DATA_AT, DICTIONARY_AT = 5, 6, 7, 9, 11
"""Fields that describe a column: its values, its bytes in memory and in the file, places."""
TROUBLE = (IndexError, KeyError, StopIteration, TypeError, AttributeError, UnicodeDecodeError)
"""What reading raises where the bytes are another thing than they should be."""


class _Page(NamedTuple):
    """A header: bytes it takes itself, those of the page in memory and in the file, its values.

    The values of a dictionary are not those of the column.
    """

    header: int
    size: int
    stored: int
    values: int
    dictionary: bool


class _Chunk(NamedTuple):
    """A column of a row group, as the footer has it: where it begins, its values, its bytes."""

    path: str
    at: int
    values: int
    size: int
    stored: int


def check_pages(file: BinaryIO, names: Iterable[str]) -> None:
    """Raise InputError unless the pages of the columns ``names`` are as large as the file says.

    Columns that are encrypted are left to pyarrow, which refuses them.
    """
    wanted, end = set(names), file.seek(0, 2)
    for chunk in _read_chunks(file, end):
        if chunk.path.partition(".")[0] in wanted:
            _check_chunk(file, chunk, end)


def _read_chunks(file: BinaryIO, end: int) -> Iterator[_Chunk]:
    """Yield the column chunks that the footer lists; InputError where it is damaged."""
    file.seek(max(end - 8, 0))
    size = int.from_bytes(file.read(4), "little")
    file.seek(max(end - 8 - size, 0))
    try:
        footer = Compact(file.read(size)).struct()
        for group in footer.get(GROUPS, []):
            for column in group[COLUMNS]:
                if META in column and ENCRYPTED not in column:
                    yield _describe(column[META])
    except TROUBLE as error:
        raise InputError("a damaged footer; copy the complete file again") from error


def _describe(meta: Fields) -> _Chunk:
    first, dictionary = int(meta[DATA_AT]), int(meta.get(DICTIONARY_AT, 0))
    # Some writers state a place of no dictionary.
    at = dictionary if 0 < dictionary < first else first
    path = b".".join(meta[PATH]).decode("utf-8")
    return _Chunk(path, at, int(meta[COUNT]), int(meta[UNPACKED]), int(meta[PACKED]))


def _check_chunk(file: BinaryIO, chunk: _Chunk, end: int) -> None:
    at, left = chunk.at, chunk.values
    end = min(end, at + chunk.stored)
    while 0 <= at < end and left > 0:
        page = _read_header(file, at, chunk.path)
        at += page.header + page.stored
        large = page.size > max(ALWAYS, LARGEST_RATIO * page.stored)
        wrong = min(page.size, page.stored, page.values) < 0 or page.size > chunk.size or at > end
        if large or wrong or (not page.dictionary and page.values > left):
            raise InputError(
                f"column {chunk.path}: a page of {page.values} values and {page.size} bytes, "
                f"{page.stored} in the file, in a column of {chunk.values} values and "
                f"{chunk.size} bytes; copy the complete file again, or write smaller pages"
            )
        left -= 0 if page.dictionary else page.values


def _read_header(file: BinaryIO, at: int, column: str) -> _Page:
    for most in HEADERS:
        file.seek(at)
        reader = Compact(file.read(most))
        try:
            fields = reader.struct()
            kind = next(k for k in KINDS if k in fields)
            values = int(fields[kind][VALUES])
            return _Page(reader.at, int(fields[SIZE]), int(fields[STORED]), values, kind == 7)
        except TROUBLE:
            continue
    raise InputError(f"column {column}: no page at byte {at}; copy the complete file again")
