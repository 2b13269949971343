"""Write where what is valid is wrong into docs/families.md and the data of its tests.

    conformance table --family all --drives 2 --json --plot families.png > families.json
    python .ci/families_wrong.py families.json

The data have, for every pipeline and condition, the wheel paths that are wrong along both
distances and those that are wrong along the true one alone, whose axis counts too.
"""

import json
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "families.md"
DATA = ROOT / "tests" / "docs" / "data" / "families.json"
BEGIN = "<!-- wrong: made by `python .ci/families_wrong.py families.json` -->\n"
END = "<!-- end of wrong -->"


def shorten(document: dict[str, Any]) -> dict[str, Any]:
    """Return settings, and counts of wrong wheel paths by pipeline and condition."""
    both: dict[str, dict[str, int]] = {p["pipeline"]: {} for p in document["paths"]}
    true: dict[str, dict[str, int]] = {name: {} for name in both}
    for path in document["paths"]:
        scores, name = path["scores"], f"{path['family']}: {path['condition']}"
        if scores is None or scores["true"]["valid_is_right"]:
            continue
        counts = (true if scores["encoder"]["valid_is_right"] else both)[path["pipeline"]]
        counts[name] = counts.get(name, 0) + 1
    settings = {key: document[key] for key in ("family", "seed", "drives")}
    return settings | {"wrong": both, "wrong_along_true_distance_alone": true}


def make_table(data: dict[str, Any]) -> str:
    """Return the table in Markdown: what is wrong along the true distance alone is in brackets."""
    rows = ["| pipeline | conditions with wrong wheel paths, of four |", "|---|---|"]
    for pipeline, found in data["wrong"].items():
        alone = data["wrong_along_true_distance_alone"][pipeline]
        cells = [f"{name} {count}" for name, count in found.items()]
        cells += [f"({name} {count})" for name, count in alone.items() if name not in found]
        rows.append(f"| `{pipeline}` | {'; '.join(cells) or '–'} |")
    return "\n".join(rows) + "\n"


def fill(page: str, data: dict[str, Any]) -> str:
    """Return ``page`` with the table of ``data`` between its marks."""
    before, begin, rest = page.partition(BEGIN)
    if not begin or END not in rest:
        raise SystemExit(f"{PAGE}: has no {BEGIN.strip()} to {END}; put both in")
    return before + BEGIN + make_table(data) + END + rest.partition(END)[2]


def main(document: Path) -> None:
    """Write page and data."""
    data = shorten(json.loads(document.read_text(encoding="utf-8")))
    DATA.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    PAGE.write_text(fill(PAGE.read_text(encoding="utf-8"), data), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
