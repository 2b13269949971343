"""Compare two reports of `conformance run`: everything but the texts and the version.

    python .ci/same_reports.py OLD NEW

OLD and NEW are `report.json` or the folders that hold them. Ids, outcomes, classes, cases, and
every number have to be the same, numbers bit for bit; so do the kept cases beside the reports.
Prints one line for each difference and exits with 1 if there is one, with 2 for files that cannot
be read.
"""

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

TEXTS = {"reason", "clause", "quantity", "version", "made_by"}
"""Keys whose strings may differ: they are written for people, or name the program."""


def main(old: Path, new: Path) -> int:
    """Print how the reports differ; return the exit code."""
    try:
        pair = [documents(path) for path in (old, new)]
    except (OSError, ValueError) as error:
        print(f"same_reports: {error}", file=sys.stderr)
        return 2
    found = list(differences("", *pair))
    for line in found:
        print(line)
    print(f"{old} and {new}: {len(found) or 'no'} difference{'s' * (len(found) != 1)}")
    return 1 if found else 0


def documents(path: Path) -> dict[str, Any]:
    """Return the report at ``path`` and the cases kept beside it, by file name."""
    report = path / "report.json" if path.is_dir() else path
    files = [report, *sorted((report.parent / "cases").glob("*.json"))]
    return {file.name: json.loads(file.read_text(encoding="utf-8")) for file in files}


def differences(where: str, old: Any, new: Any) -> Iterator[str]:
    """Yield a line for each value below ``where`` that is not the same in both."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in sorted(old.keys() | new.keys()):
            if key in old and key in new:
                if not (key in TEXTS and isinstance(old[key], str) and isinstance(new[key], str)):
                    yield from differences(f"{where}/{key}", old[key], new[key])
            else:
                yield f"{where}/{key}: only in the {'old' if key in old else 'new'} one"
    elif isinstance(old, list) and isinstance(new, list):
        yield from listed(where, old, new)
    elif exactly(old) != exactly(new):
        yield f"{where}: {old!r} became {new!r}"


def listed(where: str, old: list[Any], new: list[Any]) -> Iterator[str]:
    """Yield the differences of two lists, whose entries are named by their ids where they have."""
    if len(old) != len(new):
        yield f"{where}: {len(old)} entries became {len(new)}"
    for at, (one, two) in enumerate(zip(old, new, strict=False)):
        name = one.get("id", at) if isinstance(one, dict) else at
        yield from differences(f"{where}/{name}", one, two)


def exactly(value: Any) -> tuple[type, object]:
    """Return what two equal values have in common: type, and for a number every bit."""
    return type(value), value.hex() if isinstance(value, float) else value


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
