"""Fuzz the C library: drawn calls, possible and impossible, under the sanitizers of the compiler.

``python tests/fuzz/fuzz_c_library.py --minutes 10`` does half of the time in double precision and
half in float, by clang where it is installed: it also finds sums with NULL. It ends with 1 at the
first finding, which the sanitizer prints with its place.
"""

import argparse
import secrets
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from floatref.c import amalgamation

SANITIZERS = "address,undefined,float-divide-by-zero,float-cast-overflow"
FLAGS = ("-std=c99", "-g", "-O1", f"-fsanitize={SANITIZERS}", "-fno-sanitize-recover=all")


def build(folder: Path, precision: str, compiler: str = "cc") -> Path:
    """Return the fuzzer, built in ``folder`` with the library of one precision in it."""
    amalgamation.main([str(folder)])
    program = folder / f"fuzz-{precision}"
    macro = ["-DFR_FLOAT"] if precision == "float" else []
    sources = [Path(__file__).parent / "c_library.c", folder / "floatref.c"]
    command = [compiler, *FLAGS, *macro, f"-I{folder}", *map(str, sources), "-lm", "-o", program]
    subprocess.run(command, check=True)
    return program


def main(arguments: list[str]) -> int:
    """Run both fuzzers; return the exit code."""
    parser = argparse.ArgumentParser(description="Fuzz the C library under the sanitizers.")
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=secrets.randbelow(10**9))
    chosen = parser.parse_args(arguments)
    for precision in ("double", "float"):
        with tempfile.TemporaryDirectory(prefix="fuzz-c-") as folder:
            program = build(Path(folder), precision, shutil.which("clang") or "cc")
            seconds = round(30 * chosen.minutes)
            print(f"{precision}, seed {chosen.seed}, {seconds} s: ", end="", flush=True)
            if subprocess.run([program, str(chosen.seed), str(seconds)]).returncode != 0:
                return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
