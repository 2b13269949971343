"""Run the benchmarks that docs/performance-here.md cites, and write its figures.

    python tests/benchmarks/write_figures.py [--only NAME ...] [--busy] [--list]

What each benchmark prints is kept in docs/data/performance.json, with the machine, the date, the
commit, and how many processors other work kept busy meanwhile; then the pages are written. A
machine whose load average is above 0.5 is refused, unless `--busy` is given: the page then says so.
Benchmarks that are not named keep what they have printed before. `growth` takes hours and some
70 GB in TMPDIR and is run only by its name. filterpy and JAX, where they are to be measured, come
by ``pip install -r tests/benchmarks/requirements-kalman.txt``.
"""

import argparse
import importlib.util
import json
import subprocess
import sys
import time
from typing import Any

from figure_rows import COMMANDS
from machine import IDLE, ROOT, Others, commit, load, where

STORED = ROOT / "docs" / "data" / "performance.json"
PEERS = ("filterpy", "jax")
LONG = ("growth",)
Stored = dict[str, dict[str, Any]]


def measured(name: str) -> dict[str, Any]:
    """Run a benchmark; return what it prints and what it ran on."""
    words = ["tests/benchmarks/" + COMMANDS[name].split()[0], *COMMANDS[name].split()[1:]]
    at, begin, others = {**where(), "commit": commit(), "load": load()}, time.time(), Others()
    found = subprocess.run([sys.executable, *words], cwd=ROOT, stdout=subprocess.PIPE, text=True)
    if found.returncode:
        raise RuntimeError(f"{COMMANDS[name]} ended with {found.returncode}")
    taken = {"seconds": round(time.time() - begin), "others": round(others.processors(), 2)}
    return {"command": COMMANDS[name], **at, **taken, "printed": found.stdout.splitlines()}


def run(names: list[str], stored: Stored) -> list[str]:
    """Measure each and keep it; return those that failed."""
    failed = []
    for name in names:
        try:
            stored[name] = measured(name)
        except RuntimeError as problem:
            print(f"{name}: {problem}", flush=True)
            failed.append(name)
            continue
        STORED.write_text(json.dumps(stored, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        each = stored[name]
        print(f"{name}: {each['seconds']} s, others kept {each['others']} processors busy",
              flush=True)  # fmt: skip
    return failed


def main() -> int:
    """Run what is asked for and write the pages; 1 if a benchmark failed, 2 on a busy machine."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=COMMANDS, metavar="NAME")
    parser.add_argument("--busy", action="store_true", help="measure on a busy machine, too")
    parser.add_argument("--list", action="store_true", help="print the names and commands")
    given = parser.parse_args()
    if given.list:
        print("\n".join(f"{name:12} {command}" for name, command in COMMANDS.items()))
        return 0
    if load() > IDLE and not given.busy:
        print(f"load average {load()}: not idle (above {IDLE}); wait, or give --busy")
        return 2
    for name in (each for each in PEERS if importlib.util.find_spec(each) is None):
        print(f"{name} is not installed: its rows are left out")
    stored: Stored = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    failed = run(given.only or [name for name in COMMANDS if name not in LONG], stored)
    subprocess.run([sys.executable, "tests/benchmarks/performance_pages.py"], cwd=ROOT, check=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
