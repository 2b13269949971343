"""Mutations of an input: bits, cuts, repeats, splices, and words of the text exchanged.

They know no format. Words that parsers confuse, such as 1e999, take the place of what looks like
one, so that a document stays whole often enough to be read beyond its syntax.
"""

import random
import re
from collections.abc import Sequence

WORD = re.compile(rb"[\w.+-]+")
WORDS = (
    *(b"0", b"-1", b"1e999", b"-0.0", b"1e-320", b"9223372036854775808", b"1" * 400),
    *(b"nan", b"NaN", b"Infinity", b"null", b"true", b"[]", b"{}", b'""', b"[[[[", b"0x1", b"1_0"),
    *(b"..", b"/", b"\\u0000", b"\\ud800", b"\xc3\xa9", b"\xed\xa0\x80", b"\x00", b"\x1b[2J"),
)
BYTES = (b"\x00", b"\x01", b"\x7f", b"\x80", b"\xff")
MOST_BYTES = 1 << 16


def mutate(data: bytes, others: Sequence[bytes], draw: random.Random) -> bytes:
    """Return ``data`` with one to four mutations; parts of ``others`` are spliced in."""
    for _ in range(draw.choice((1, 1, 1, 2, 3, 4))):
        data = draw.choice(MUTATIONS)(data, others, draw)
    return data[:MOST_BYTES]


def _flip(data: bytes, others: Sequence[bytes], draw: random.Random) -> bytes:
    if not data:
        return draw.randbytes(4)
    at = draw.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << draw.randrange(8)]) + data[at + 1 :]


def _cut(data: bytes, others: Sequence[bytes], draw: random.Random) -> bytes:
    start, end = sorted(draw.randrange(len(data) + 1) for _ in range(2))
    return data[:start] if draw.random() < 0.3 else data[:start] + data[end:]


def _repeat(data: bytes, others: Sequence[bytes], draw: random.Random) -> bytes:
    start, end = sorted(draw.randrange(len(data) + 1) for _ in range(2))
    return data[:end] + data[start:end] * draw.choice((1, 1, 2, 40)) + data[end:]


def _splice(data: bytes, others: Sequence[bytes], draw: random.Random) -> bytes:
    other = draw.choice(others) if others else data
    start, end = sorted(draw.randrange(len(other) + 1) for _ in range(2))
    at = draw.randrange(len(data) + 1)
    gone = draw.choice((0, end - start))
    return data[:at] + other[start:end] + data[at + gone :]


def _overwrite(data: bytes, others: Sequence[bytes], draw: random.Random) -> bytes:
    at, count = draw.randrange(len(data) + 1), draw.choice((1, 2, 4, 8))
    put = draw.choice(BYTES) * count if draw.random() < 0.7 else draw.randbytes(count)
    return data[:at] + put + data[at + count :]


def _exchange_word(data: bytes, others: Sequence[bytes], draw: random.Random) -> bytes:
    words = [match.span() for match in WORD.finditer(data)]
    if not words:
        return data + draw.choice(WORDS)
    start, end = draw.choice(words)
    own = draw.choice(words)
    put = draw.choice(WORDS) if draw.random() < 0.6 else data[slice(*own)]
    return data[:start] + put + data[end:]


MUTATIONS = (_flip, _cut, _repeat, _splice, _overwrite, _exchange_word, _exchange_word)
