"""`worksheet.html`: one file that needs nothing else, to be read, signed and filed."""

from pathlib import Path

from floatref.files.atomic import replacing_file
from floatref_conformance.certify.worksheet import Worksheet
from floatref_conformance.render.templating import filled, needs_jinja
from floatref_conformance.render.worksheet_rows import page_of

NAME = "worksheet.html"
TEMPLATE = "worksheet.html.j2"


def write_page(worksheet: Worksheet, path: Path) -> None:
    """Write the page of ``worksheet`` beside ``path`` and rename it.

    Raises InputError where the package that fills in the page is not installed, or ``path``
    cannot be written.
    """
    needs_jinja(NAME)
    with replacing_file(path, overwrite=True) as beside:
        beside.write_text(as_html(worksheet), encoding="utf-8")


def as_html(worksheet: Worksheet) -> str:
    """Return the page that shows ``worksheet``.

    Whatever a file said is text in it, never markup, and nothing in it leads to another file.
    """
    return filled(TEMPLATE, page=page_of(worksheet))
