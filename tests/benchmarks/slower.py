"""Print which stages take over 5 % more instructions than counts.json has, a line for each.

CI runs it as `.ci/slower`. It never fails: a reader decides whether the cost is worth its purpose.
With `--write` it stores the counts of this tree, which belong in the commit that changes them.
Counts of another compiler or machine cannot be compared, which a line says. Pipelines are counted
with `--pipelines` alone, for their kernels are compiled before.
"""

import argparse
import json
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import instructions

STORED = Path(__file__).with_name("counts.json")
SHARE = 0.05
LONGEST_S = 60.0
"""Time by the clock after which the counts are given up; an idle machine needs a fraction."""
Counts = Mapping[str, float]
Found = dict[str, dict[str, Any]]
"""Counts per sample, and the tools that they depend on, of stages and of pipelines."""


def differences(before: Counts, now: Counts) -> list[str]:
    """Return what there is to say of counts per sample, beside those that were stored."""
    both = {name: (before[name], count) for name, count in now.items() if name in before}
    fewer = [name for name, (old, new) in both.items() if new < (1.0 - SHARE) * old]
    found = [
        f"{name} takes {new:.1f} instructions per sample, {old:.1f} before: {new / old - 1.0:+.1%}"
        for name, (old, new) in both.items()
        if new > (1.0 + SHARE) * old
    ]
    if fewer:
        found.append(f"{', '.join(fewer)} became faster: store it by .ci/slower --write")
    if set(now) != set(before):
        changed = ", ".join(sorted(set(now) ^ set(before)))
        found.append(f"{changed}: added or removed, store it by .ci/slower --write")
    return found


def report(stored: Found, found: Found) -> list[str]:
    """Return the lines on all that was counted now."""
    lines = []
    for kind, now in found.items():
        before = stored.get(kind, {"tools": {}, "counts": {}})
        if before["tools"] == now["tools"]:
            lines += differences(before["counts"], now["counts"])
        else:
            old, new = (", ".join(each["tools"].values()) for each in (before, now))
            lines.append(f"{kind} cannot be compared, counted with {old or 'nothing'}; now {new}")
    number = sum(len(each["counts"]) for each in found.values())
    return lines or [f"nothing of {number} by more than {SHARE:.0%}"]


def count(pipelines: bool, longest_s: float | None) -> Found:
    """Return the counts of this tree."""
    counts = instructions.of_stages(instructions.stages(), longest_s=longest_s)
    found: Found = {"stages": {"tools": instructions.tools(), "counts": counts}}
    if pipelines:
        counts = instructions.of_pipelines(instructions.PIPELINES)
        found["pipelines"] = {"tools": instructions.python_tools(), "counts": counts}
    return found


def stored() -> Found:
    """Return what is stored."""
    found: Found = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    return found


def lines(write: bool, pipelines: bool) -> list[str]:
    """Count, and return the lines."""
    missing = instructions.missing_tools()
    if missing:
        return [f"skipped, {', '.join(missing)} is not installed"]
    try:
        found = count(pipelines, None if write else LONGEST_S)
    except subprocess.TimeoutExpired:
        return [f"skipped, not counted in {LONGEST_S:g} s"]
    except RuntimeError as problem:
        return [f"skipped, {str(problem).splitlines()[0]}"]
    if write:
        STORED.write_text(json.dumps(stored() | found, indent=1) + "\n", encoding="utf-8")
    return report(stored(), found)


def main() -> int:
    """Print the lines."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="store the counts of this tree")
    parser.add_argument("--pipelines", action="store_true", help="count whole pipelines, too")
    given = parser.parse_args()
    for line in lines(given.write, given.pipelines):
        print(f"== slower: {line}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
