"""Hold the table of class nominal in docs/conformance.md to runs of the judge, or renew it.

    python .ci/class_table.py [--write] [DEVICE ...]

A run takes some minutes; without DEVICE every row is run. Of a row, the number of checks passed and
the checks that fail are of edition 2026.2; the verdict of 2026.1 is left as it is.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

PAGE = Path(__file__).parents[1] / "docs" / "conformance.md"
ROW = re.compile(r"^\| `(builtin:[a-z0-9-]+)` \| (PASS|FAIL) \| (\d+)( of \d+)? \| (.+) \|$", re.M)
JUDGE = "from floatref_conformance.cli.main import main; main()"


class Row(NamedTuple):
    """A device, how many checks it passes and which it fails."""

    device: str
    passed: int
    fails: frozenset[str]


def rows_of_page() -> list[Row]:
    """Return the rows of the table."""
    text = PAGE.read_text(encoding="utf-8")
    found = [
        (m[1], int(m[3]), frozenset(re.findall(r"`([a-z-]+)`", m[5]))) for m in ROW.finditer(text)
    ]
    return [Row(*row) for row in found]


def judge(device: str, *only: str) -> Row:
    """Return the row of a run of ``device`` in class nominal with seed 0, of checks ``only``."""
    words = ["run", "--device", device, "--seed", "0", "--class", "nominal", "--json"]
    words += [word for name in only for word in ("--check", name)]
    done = subprocess.run([sys.executable, "-c", JUDGE, *words], capture_output=True, text=True)
    checks = [c for c in json.loads(done.stdout)["checks"] if not only or c["id"] in only]
    failed = [check["id"] for check in checks if check["outcome"] != "pass"]
    return Row(device, len(checks) - len(failed), frozenset(failed))


def renewed(text: str, row: Row) -> str:
    """Return the page with ``row`` in place of the device's; the order of checks is the judge's."""
    from floatref_conformance.checks.catalogue import IDS

    names = ", ".join(f"`{name}`" for name in IDS if name in row.fails) or "–"

    def line(found: re.Match[str]) -> str:
        if found[1] != row.device:
            return found[0]
        return f"| `{row.device}` | {found[2]} | {row.passed}{found[4] or ''} | {names} |"

    return ROW.sub(line, text)


def main() -> int:
    """Run the devices; return 1 if the page says otherwise and is not to be written."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="replace the rows that differ")
    parser.add_argument("devices", nargs="*", metavar="DEVICE")
    given = parser.parse_args()
    wrong = False
    for row in rows_of_page():
        if given.devices and row.device not in given.devices:
            continue
        found = judge(row.device)
        if found != row:
            wrong = True
            print(f"{row}\n  {found}", flush=True)
        if given.write:
            text = renewed(PAGE.read_text(encoding="utf-8"), found)
            PAGE.write_text(text, encoding="utf-8")
    return int(wrong and not given.write)


if __name__ == "__main__":
    sys.exit(main())
