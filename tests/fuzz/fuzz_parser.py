"""Fuzz one parser of `PARSERS`: any bytes are read, or one `InputError` of one line.

Run it as `harness` says, with the name of the parser before the options:

    python tests/fuzz/fuzz_parser.py practice --seconds 20

A parser leaves nothing behind beside the files that it is given.
"""

import sys
import warnings
from collections.abc import Callable
from pathlib import Path

from harness import fuzz, instrumented, one_line, scratch
from parsers import PARSERS, Parser, Read

with instrumented():
    import floatref  # noqa: F401


def reader(parser: Parser, read: Read, folder: Path) -> Callable[[bytes], None]:
    """Return what reads an input by ``parser``, whose files are in ``folder``."""

    def read_any(data: bytes) -> None:
        path = parser.write(data, folder)
        before = sorted(folder.rglob("*"))
        one_line(read, path)
        if sorted(folder.rglob("*")) != before:
            raise AssertionError(f"left behind: {sorted(folder.rglob('*'))}")

    return read_any


def main(name: str) -> None:
    """Fuzz the parser ``name``."""
    folder = scratch(name)
    with instrumented():
        read = PARSERS[name].load()
    from parser_seeds import make_seeds

    warnings.simplefilter("error")
    seeds = make_seeds(name, scratch(f"{name}-seeds"))
    fuzz(name, reader(PARSERS[name], read, folder), seeds)


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1] not in PARSERS:
        sys.exit(f"name one of these first: {', '.join(PARSERS)}")
    main(sys.argv.pop(1))
