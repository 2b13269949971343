"""Run every fuzzer of this folder for some seconds, two side by side; 1 if one finds something.

    python tests/fuzz/every_entry.py --seconds 5
    python tests/fuzz/every_entry.py --seconds 300 --atheris --corpora CORPORA

drives them by our own driver, and by atheris. `fuzz_c_library`, which draws calls, is not among
them: a test and the nightly part run it.
"""

import argparse
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import MappingProxyType

from harness import keep, last_input
from parsers import NATIVE, PARSERS

HERE = Path(__file__).parent
STARTING_S = 120.0
"""In which a fuzzer starts and ends on a busy machine, beside the seconds that it is given."""
OWN = ("csv", "erd", "map", "vendor_logger", "firmware_c")
"""Those with a script of their own."""
UNGUIDED = ("firmware_c",)
"""Those that atheris cannot guide."""
ENTRIES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        **{name: ("fuzz_native.py", name) for name in NATIVE},
        **{name: (f"fuzz_{name}.py",) for name in OWN},
        **{name: ("fuzz_parser.py", name) for name in PARSERS},
    }
)
"""Script and words of every fuzzer."""
ADAPTERS: Mapping[str, str] = MappingProxyType({**{name: name for name in NATIVE}, "csv": "csv"})
"""The entry of every adapter."""
PROFILES: Mapping[str, str] = MappingProxyType(
    {
        "profile": "profile_directory",
        "csv": "profile_csv",
        "erd": "erd",
        "text": "viewer_text",
        "parquet": "profile_parquet",
    }
)
"""The entry of every format of profiles."""


def command(name: str, seconds: float, corpora: Path | None, atheris: bool) -> list[str]:
    """Return the command of an entry; its corpus is a folder in ``corpora``, which is made."""
    script, *words = ENTRIES[name]
    guided = atheris and name not in UNGUIDED
    words += (
        [f"-max_total_time={round(seconds)}", "-timeout=20"]
        if guided
        else ["--seconds", str(seconds)]
    )
    if corpora is not None:
        (corpora / name).mkdir(parents=True, exist_ok=True)
        words.append(str((corpora / name).resolve()))
    return [sys.executable, str(HERE / script), *words]


def run_entry(name: str, words: Sequence[str], seconds: float) -> bool:
    """Run one entry, print its last line, or all if it found something; return whether not."""
    started = time.monotonic()
    process = subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
    )
    try:
        said, _ = process.communicate(timeout=seconds + STARTING_S)
    except subprocess.TimeoutExpired:
        process.kill()
        said, _ = process.communicate()
    if process.returncode == 0:
        last = said.strip().splitlines()[-1:] or [name]
        print(f"{last[0]}, {time.monotonic() - started:.0f} s", flush=True)
        return True
    print(f"== {name} found something, exit code {process.returncode}\n{said.strip()}", flush=True)
    place = last_input(name, process.pid)
    if place.exists():
        print(f"{name}: the process ended at the input in {keep(place)}", flush=True)
    return False


def main(arguments: Sequence[str]) -> int:
    """Run the fuzzers as ``arguments`` say, and return the exit code."""
    parser = argparse.ArgumentParser(description="Run every fuzzer.")
    parser.add_argument("--seconds", type=float, required=True, help="for each")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--corpora", type=Path, help="folder in which corpora are kept and grow")
    parser.add_argument("--atheris", action="store_true")
    parser.add_argument("names", nargs="*", metavar="NAME", help="these alone")
    given = parser.parse_args(arguments)
    names = given.names or list(ENTRIES)
    if unknown := set(names) - set(ENTRIES):
        parser.error(f"no entry {', '.join(sorted(unknown))}; known: {', '.join(ENTRIES)}")
    commands = {n: command(n, given.seconds, given.corpora, given.atheris) for n in names}
    with ThreadPoolExecutor(given.jobs) as pool:
        sound = pool.map(lambda name: run_entry(name, commands[name], given.seconds), names)
        return 0 if all([*sound]) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
