"""Damage to files, which are then read or refused."""

import random
from collections.abc import Iterator
from pathlib import Path

from hypothesis import strategies as st

from floatref import InputError
from floatref_adapters.testing.whole_reading import Opener, whole


def check_damaged(adapter: Opener, path: Path, data: st.DataObject) -> None:
    """Assert that a file that is cut and changed here and there is read or refused in a line."""
    content = path.read_bytes()
    size = len(content)
    text = bytearray(content[: data.draw(st.integers(0, size) | st.just(size))])
    for _ in range(data.draw(st.integers(0, 4))):
        if text:
            text[data.draw(st.integers(0, len(text) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(text)
    said = ""
    try:
        for stream in adapter.streams(path, {}).streams:
            values, _ = whole(stream)
            assert {len(column) for column in values.values()} <= {stream.count}
    except InputError as error:
        said = str(error)
    assert "\n" not in said


def with_wrong_numbers(sound: bytes, draw: random.Random, first: int) -> Iterator[bytes]:
    """Yield ``sound`` with a few numbers from byte ``first`` on that are wrong, or cut short."""
    while True:
        damaged = bytearray(sound)
        if draw.random() < 0.15:
            del damaged[draw.randrange(first, len(damaged)) :]
        for _ in range(draw.choice([1, 1, 2, 6]) if len(damaged) == len(sound) else 0):
            place, size = draw.randrange(first, len(sound) - 8), draw.choice([1, 1, 4, 8])
            number = draw.choice([0, 1, 64, 2**63, 2**64 - 1, draw.randrange(2**64)])
            damaged[place : place + size] = (number % 2 ** (8 * size)).to_bytes(size, "little")
        yield bytes(damaged)
