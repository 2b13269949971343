"""What the fuzzers share: their corpora, the driver, and refusals of one line.

    python tests/fuzz/fuzz_csv.py --seconds 20 [CORPUS]

runs the driver of our own. Without ``--seconds`` atheris drives, guided by the lines that an input
reaches. It is no dependency of floatref: `pip install atheris` into an environment of its own, with
floatref in it. Then, with a folder for the inputs that are found (it may be empty):

    python tests/fuzz/fuzz_csv.py -max_total_time=600 CORPUS

A crash is written as `crash-…` to the working directory; give that file in place of CORPUS, and 0
seconds to our own driver, to see it again.
"""

import argparse
import atexit
import hashlib
import os
import random
import secrets
import shutil
import sys
import tempfile
import traceback
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

from plain_driver import MEMORY, Driver, Found

KEPT = Path(__file__).parent / "corpus"
"""Inputs of the repository, in a folder for each entry."""
PLAIN = "--seconds" in sys.argv
LAST_REFUSAL: list[str | None] = [None]

Mutate = Callable[[bytes, int, int], bytes]


def instrumented(**names: Any) -> AbstractContextManager[object]:
    """Return the context in which atheris, if it drives, instruments what is imported."""
    if PLAIN:
        return nullcontext()
    import atheris

    context: AbstractContextManager[object] = atheris.instrument_imports(**names)
    return context


def scratch(name: str) -> Path:
    """Return a new folder, which goes with this process."""
    folder = Path(tempfile.mkdtemp(prefix=f"fuzz-{name}-", dir=MEMORY))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def last_input(name: str, process: int) -> Path:
    """Return where a process of `name` writes its input before it reads it."""
    return Path(MEMORY or tempfile.gettempdir()) / f"crash-{name}-{process}"


def keep(place: Path) -> Path:
    """Move the input at ``place`` to the working directory, and return where it is."""
    return Path(shutil.move(place, place.name))


def fuzz(
    name: str,
    read_any: Callable[[bytes], None],
    seeds: Iterable[bytes],
    mutated: Mutate | None = None,
) -> None:
    """Fuzz ``name``, from ``seeds``, its kept inputs and those of the corpus folder."""
    kept = [*seeds, *(p.read_bytes() for p in sorted((KEPT / name).glob("*")))]
    if PLAIN:
        sys.exit(_drive(name, read_any, kept))
    import atheris

    folders = [Path(argument) for argument in sys.argv[1:] if Path(argument).is_dir()]
    for number, seed in enumerate(kept):
        for folder in folders[:1]:
            (folder / f"seed-{number}").write_bytes(seed)
    atheris.Setup(sys.argv, read_any, **({"custom_mutator": mutated} if mutated else {}))
    atheris.Fuzz()


def _drive(name: str, read_any: Callable[[bytes], None], seeds: list[bytes]) -> int:
    """Run our own driver as the arguments say, and return the exit code."""
    parser = argparse.ArgumentParser(description=f"Fuzz {name}.")
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("--seed", type=int, default=secrets.randbelow(10**9))
    parser.add_argument("corpus", nargs="?", type=Path, help="a folder, or one input")
    given = parser.parse_args()
    place = last_input(name, os.getpid())
    driver = Driver(read_any, lambda: LAST_REFUSAL[0], place)
    try:
        driver.run([*seeds, *_inputs(given.corpus)], given.seconds, random.Random(given.seed))
    except Found as found:
        traceback.print_exception(found)
        print(f"{name}: {found}; the input is in {keep(place)}")
        return 1
    place.unlink(missing_ok=True)
    if given.corpus is not None and given.corpus.is_dir():
        for data in driver.corpus:
            (given.corpus / hashlib.sha256(data).hexdigest()[:16]).write_bytes(data)
    print(f"{name}, seed {given.seed}: {driver.count} inputs, {len(driver.corpus)} kept")
    return 0


def _inputs(corpus: Path | None) -> list[bytes]:
    if corpus is None:
        return []
    return [p.read_bytes() for p in (sorted(corpus.glob("*")) if corpus.is_dir() else [corpus])]


def one_line(function: Callable[..., object], *args: object) -> object:
    """Return what ``function`` returns, None if it refuses in a line that can be printed."""
    # Imported here, floatref is what each fuzzer has instrumented.
    from floatref import InputError

    LAST_REFUSAL[0] = None
    try:
        return function(*args)
    except InputError as error:
        LAST_REFUSAL[0] = str(error)
        if not str(error).isprintable():
            raise AssertionError(f"not one line: {error!r}") from error
        return None
