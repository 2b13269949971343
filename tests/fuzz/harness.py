"""What the fuzzers share: seeds where there is a corpus folder, and refusals of one line.

atheris is no dependency of floatref: `pip install atheris` into an environment of its own, with
floatref in it. Then, with a folder for the inputs that are found (it may be empty):

    python tests/fuzz/fuzz_csv.py -max_total_time=600 CORPUS

A crash is written as `crash-…` beside where it ran; give that file in place of CORPUS to see it
again.
"""

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import atheris


def fuzz(
    read_any: Callable[[bytes], None],
    seeds: Iterable[bytes],
    mutated: Callable[[bytes, int, int], bytes] | None = None,
) -> None:
    """Fuzz, with the inputs of the corpus folder, into which ``seeds`` are put."""
    folders = [Path(argument) for argument in sys.argv[1:] if Path(argument).is_dir()]
    for number, seed in enumerate(seeds):
        for folder in folders[:1]:
            (folder / f"seed-{number}").write_bytes(seed)
    atheris.Setup(sys.argv, read_any, **({"custom_mutator": mutated} if mutated else {}))
    atheris.Fuzz()


def one_line(function: Callable[..., object], *args: object) -> object:
    """Return what ``function`` returns, None if it refuses in a line that can be printed."""
    # Imported here, floatref is what each fuzzer has instrumented.
    from floatref import InputError

    try:
        return function(*args)
    except InputError as error:
        if not str(error).isprintable():
            raise AssertionError(f"not one line: {error!r}") from error
        return None
