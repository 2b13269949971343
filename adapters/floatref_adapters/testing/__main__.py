"""`python -m floatref_adapters.testing RECORDING FILE`: a recording in another format."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from floatref import InputError, read_recording
from floatref_adapters.testing import WRITERS


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the file and return 0, or say in one line why not and return 2."""
    parser = argparse.ArgumentParser("python -m floatref_adapters.testing", description=__doc__)
    parser.add_argument("recording", type=Path, help="a recording directory")
    parser.add_argument("file", type=Path, help=f"with a suffix of {', '.join(WRITERS)}")
    parser.add_argument(
        "--quantum",
        action="append",
        default=[],
        metavar="CHANNEL=VALUE",
        help="round this channel's samples to multiples of VALUE, in its SI unit",
    )
    given = parser.parse_args(arguments)
    try:
        _write(given.recording, given.file, given.quantum)
    except ValueError as error:
        # An InputError is one, and so is a quantum that a format cannot hold.
        print(f"Error: {error}", file=sys.stderr)
        return 2
    return 0


def _write(source: Path, path: Path, quanta: Sequence[str]) -> None:
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise InputError(f"{path}: no format of that suffix; use {', '.join(WRITERS)}")
    writer(read_recording(source), path, dict(_quantum(text) for text in quanta))


def _quantum(text: str) -> tuple[str, float]:
    name, _, value = text.rpartition("=")
    try:
        return name, float(value)
    except ValueError:
        raise InputError(f"--quantum {text}: give CHANNEL=VALUE, such as height=1e-5") from None


if __name__ == "__main__":
    sys.exit(main())
