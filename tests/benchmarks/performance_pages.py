"""Write the tables on performance from what was measured.

    python tests/benchmarks/performance_pages.py [--check]

`tests/benchmarks/write_figures.py` takes the measurements, and `.ci/slower --write` counts
instructions. A table stands in a page between `<!-- figures: NAME -->` and `<!-- end -->`.
`--check` compares instead.
"""

import argparse
import json
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import figures
import growth_runs
from machine import BUSY, ROOT

DATA = ROOT / "docs" / "data"
COUNTS = Path(__file__).with_name("counts.json")
PAGES = ("performance-here.md", "performance-growth.md")
PLACE = re.compile(r"(<!-- figures: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
HEAD = ("what", "floatref", "peer, in the same run", "ratio", "aim", "met", "command")
DISTURBED = (
    "**Other work kept up to {:.2g} of the processors busy: ratios and bytes hold, but times are "
    "too long.**"
)
Stored = dict[str, Any]


def table(head: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """Return a table."""
    rows = [head, ("---",) * len(head), *lines]
    return "".join(f"| {' | '.join(line)} |\n" for line in rows)


def here() -> str:
    """Return what each benchmark printed, and what it ran on."""
    stored: dict[str, Stored] = json.loads((DATA / "performance.json").read_text(encoding="utf-8"))
    printed = {name: "\n".join(each["printed"]) for name, each in stored.items()}
    others = max(each["others"] for each in stored.values())
    text = "".join(f"{line}\n" for line in dict.fromkeys(map(machine, stored.values())))
    return f"{text}{disturbed(others)}\n{table(HEAD, figures.table(printed))}"


def machine(at: Stored) -> str:
    """Return when and where something was measured."""
    return (
        f"Taken on {at['taken']} at `{at['commit']}` on {at['cores']} cores of an "
        f"{at['processor']}, Python {at['python']}, numpy {at['numpy']}, scipy {at['scipy']}, "
        f"numba {at['numba']}."
    )


def disturbed(others: float) -> str:
    """Return a line on a machine that was not idle."""
    return f"\n{DISTURBED.format(others)}\n" if others > BUSY else ""


def growth() -> str:
    """Return how time and memory grow, with every run."""
    at, found = growth_runs.from_json((DATA / "growth.json").read_text(encoding="utf-8"))
    runs = [(name, run) for of in found.values() for name, each in of.items() for run in each]
    lines = [f"- {growth_runs.summary(*each)}\n" for each in found["lengths"].items()]
    head = f"{machine(at)}\n{disturbed(max(run.others for _, run in runs))}\n{''.join(lines)}\n"
    return head + table(growth_runs.COLUMNS, [growth_runs.row(*each) for each in runs])


def counts() -> str:
    """Return the instructions per sample of stages and pipelines."""
    stored = json.loads(COUNTS.read_text(encoding="utf-8"))
    return "\n".join(
        f"Counted with {', '.join(each['tools'].values())}.\n\n"
        + table((kind, "instructions"), [(f"`{n}`", f"{c:.1f}") for n, c in each["counts"].items()])
        for kind, each in stored.items()
    )


PARTS: dict[str, Callable[[], str]] = {"here": here, "growth": growth, "counts": counts}


def written(text: str) -> str:
    """Return the page ``text`` with every table anew."""
    return PLACE.sub(lambda place: f"{place[1]}\n{PARTS[place[2]]()}\n{place[3]}", text)


def main() -> int:
    """Write the pages, or return 1 if one is not what it would be."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    for name in PAGES:
        page = ROOT / "docs" / name
        text = page.read_text(encoding="utf-8")
        if check and written(text) != text:
            print(f"{name}: run python tests/benchmarks/performance_pages.py", file=sys.stderr)
            return 1
        if not check:
            page.write_text(written(text), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
