"""The table shows every text as it is, and holds no markup but its own."""

from html.parser import HTMLParser

from hypothesis import given
from hypothesis import strategies as st

from floatref.values.display.html_table import html_table

OURS = {"table", "caption", "thead", "tbody", "tr", "th", "td"}
PRINTABLE = st.text(st.characters(exclude_categories=("C", "Z")))


class Cells(HTMLParser):
    """The tags of a table, and the text of each caption and cell."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.texts: list[str] = []
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note the tag; a caption or a cell begins a text."""
        self.tags.append(tag)
        if tag in ("caption", "th", "td"):
            self.texts.append("")

    def handle_data(self, data: str) -> None:
        """Add to the last text."""
        self.texts[-1] += data


@given(PRINTABLE, st.lists(PRINTABLE, min_size=2, max_size=2), st.lists(st.tuples(PRINTABLE)))
def test_every_text_is_shown_as_it_is(
    caption: str, header: list[str], rows: list[tuple[str]]
) -> None:
    found = Cells(html_table(caption, header, rows))
    assert found.texts == [caption, *header, *(cell for row in rows for cell in row)]
    assert set(found.tags) <= OURS
    assert found.tags.count("tr") == 1 + len(rows)


def test_markup_in_a_name_is_text() -> None:
    page = html_table("<b>", ["&lt;"], [["<script>alert('x')</script>"]])
    assert "<script" not in page
    assert Cells(page).texts == ["<b>", "&lt;", "<script>alert('x')</script>"]
    assert "\n" not in html_table("a\nb", [], [])
