"""Write the table of a scenario's keys into docs/scenario.md, or check it.

    python .ci/scenario_table.py [--check]

With --check nothing is written; exits with 1 if the page differs from the code.
"""

import sys
from dataclasses import fields
from pathlib import Path

from floatref_conformance.proving_ground.scenario import Scenario

PAGE = Path(__file__).parents[1] / "docs" / "scenario.md"
BEGIN = "<!-- fields: made from `Scenario` by `python .ci/scenario_table.py` -->\n"
END = "<!-- end of fields -->"


def make_table() -> str:
    """Return the table in Markdown: key, default, limits, meaning."""
    rows = ["| key | default | limits | meaning |", "|---|---|---|---|"]
    for field in fields(Scenario):
        data = field.metadata
        limits = f"{data['lowest']:g} to {data['highest']:g}" if "lowest" in data else "–"
        default = field.default
        shown = ", ".join(default) if isinstance(default, tuple) else f"{default}"
        meaning = data["meaning"].replace("|", "\\|")
        rows.append(f"| `{field.name}` | {shown.lower() if isinstance(default, bool) else shown} "
                    f"| {limits} | {meaning} |")  # fmt: skip
    return "\n".join(rows) + "\n"


def fill(page: str) -> str:
    """Return ``page`` with the present table between its marks."""
    before, _, rest = page.partition(BEGIN)
    return before + BEGIN + make_table() + END + rest.partition(END)[2]


def main(check: bool) -> int:
    """Write the page, or check it; return the exit code."""
    page = PAGE.read_text(encoding="utf-8")
    if check:
        return 0 if page == fill(page) else 1
    PAGE.write_text(fill(page), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main("--check" in sys.argv[1:]))
