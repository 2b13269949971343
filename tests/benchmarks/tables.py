"""Tables of the benchmarks: in the terminal, and in a page."""

import re
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table


def show(title: str, columns: Sequence[str], lines: Sequence[Sequence[str]], width: int) -> None:
    table = Table(title=title)
    for name in columns:
        table.add_column(name, justify="right")
    for cells in lines:
        table.add_row(*cells)
    Console(width=width).print(table)


def write_page(page: Path, lines: Sequence[Sequence[str]], columns: Sequence[str]) -> None:
    """Put ``lines`` in place of the table of a Markdown page that has these columns."""
    begin = f"| {' | '.join(columns)} |\n"
    table = begin + "|---|---" + "|---:" * (len(columns) - 2) + "|\n"
    table += "".join(f"| {' | '.join(line)} |\n" for line in lines)
    text = page.read_text(encoding="utf-8")
    found = re.compile(re.escape(begin) + r"(\|.*\n)+")
    if not found.search(text):
        raise SystemExit(f"{page}: no table with the columns {', '.join(columns)}")
    page.write_text(found.sub(lambda _: table, text), encoding="utf-8")
