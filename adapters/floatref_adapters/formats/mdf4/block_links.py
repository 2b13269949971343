"""The links between the blocks of an MDF 4 file, checked before asammdf follows them.

A damaged file may link a block to itself, or to what is no block; a reader that follows every
link would never end. Each block of a chain has to be met once, where and of the size it says.
"""

import struct
from collections.abc import Iterator
from typing import BinaryIO, NamedTuple

from floatref import InputError

HEADER = 64
"""Address of the header block, after the identification."""
MOST_LINKS = 1 << 20
MOST_CONVERSIONS = 1 << 16
"""Most conversions that one conversion may call, each counted as often as it is called."""
DEEPEST_CALL = 16
CHAINS = {
    b"##HD": {0: b"##DG", 1: b"##FH", 3: b"##AT", 4: b"##EV"},
    b"##DG": {0: b"##DG", 1: b"##CG"},
    b"##CG": {0: b"##CG", 1: b"##CN"},
    b"##CN": {0: b"##CN", 1: b"##CN ##CA"},
    b"##CA": {0: b"##CN ##CA"},
    b"##FH": {0: b"##FH"},
    b"##AT": {0: b"##AT"},
    b"##EV": {0: b"##EV"},
}
"""By the kind of a block, which of its links are followed, and the kinds they may lead to."""
CONVERSION = 4
"""Which link of a channel leads to its conversion."""
FIRST_CALLED = 4
"""Which link of a conversion is the first that it calls."""


class Block(NamedTuple):
    """Start of a block: its kind, its length in bytes, and the addresses that it links to."""

    kind: bytes
    length: int
    links: tuple[int, ...]


def read_block(file: BinaryIO, address: int, size: int) -> Block:
    """Return the start of the block at ``address`` in ``file`` of ``size`` bytes.

    InputError if it does not lie in the file with all its links.
    """
    if not HEADER <= address <= size - 24:
        raise InputError(f"a link leads to byte {address} of {size}; copy the complete file")
    file.seek(address)
    kind, length, count = struct.unpack("<4s4xQQ", file.read(24))
    if kind[:2] != b"##" or length < 24 + 8 * min(count, MOST_LINKS) or count > MOST_LINKS:
        raise InputError(f"no block where one has to be, at byte {address}; the file is damaged")
    if address + 24 + 8 * count > size:
        raise InputError(f"the file ends inside a block at byte {address}; copy the complete file")
    return Block(kind, length, struct.unpack(f"<{count}Q", file.read(8 * count)))


def check_links(file: BinaryIO, size: int) -> list[int]:
    """Return the addresses of the data groups; InputError if the links of ``file`` never end."""
    seen: set[int] = set()
    groups: list[int] = []
    called: dict[int, int] = {}
    waiting: list[tuple[int, bytes]] = [(HEADER, b"##HD")]
    while waiting:
        address, kinds = waiting.pop()
        block = read_block(file, address, size)
        if address in seen or block.kind not in kinds.split():
            raise InputError(
                f"block {_text(block)} at byte {address} has a wrong link to it; "
                "the file is damaged"
            )
        seen.add(address)
        if block.kind == b"##DG":
            groups.append(address)
        if block.kind == b"##CN" and len(block.links) > CONVERSION and block.links[CONVERSION]:
            _check_calls(file, block.links[CONVERSION], size, called, ())
        waiting.extend(_follow(block))
    return groups


def _text(block: Block) -> str:
    return block.kind.decode("latin-1")[2:]


def _follow(block: Block) -> Iterator[tuple[int, bytes]]:
    for index, kinds in CHAINS[block.kind].items():
        if index < len(block.links) and block.links[index]:
            yield block.links[index], kinds


def _check_calls(
    file: BinaryIO, address: int, size: int, called: dict[int, int], callers: tuple[int, ...]
) -> int:
    """Return how many conversions the one at ``address`` calls, itself included."""
    if address in called:
        return called[address]
    if len(callers) > DEEPEST_CALL:
        raise InputError(
            f"the conversion at byte {address} is called in a loop; the file is damaged"
        )
    block = read_block(file, address, size)
    count = 1
    if block.kind == b"##CC":
        for link in filter(None, block.links[FIRST_CALLED:]):
            count += _check_calls(file, link, size, called, (*callers, address))
    if count > MOST_CONVERSIONS:
        raise InputError(f"the conversion at byte {address} calls {count} others; simplify it")
    called[address] = count
    return count
