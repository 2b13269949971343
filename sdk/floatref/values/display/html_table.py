"""A small HTML table without scripts and styles of its own, in which every text is escaped."""

from collections.abc import Iterable, Sequence
from html import escape

from floatref.errors import one_line


def html_table(caption: str, header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table with ``caption`` above, one ``header`` and ``rows`` of cells.

    Names come from files of others: markup in them is shown as text, never interpreted.
    """
    body = "".join(_row("td", cells) for cells in rows)
    return (
        f'<table><caption style="text-align: left">{_text(caption)}</caption>'
        f"<thead>{_row('th', header)}</thead><tbody>{body}</tbody></table>"
    )


def _row(tag: str, cells: Sequence[str]) -> str:
    return f"<tr>{''.join(f'<{tag}>{_text(cell)}</{tag}>' for cell in cells)}</tr>"


def _text(text: str) -> str:
    return escape(one_line(text))
