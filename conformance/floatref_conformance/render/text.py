"""Text that came from a device or a file, made fit to be shown, and templates filled with it."""

import unicodedata
from importlib.util import find_spec
from typing import Any

from floatref.errors import missing_extra

HIDDEN = ("Cc", "Cs", "Co", "Cn")
"""Categories of characters without a picture: controls, surrogates, unassigned."""
KEPT = "\n\t"
TURNING = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
"""They turn the direction of what follows, and so make a text read as another."""


def printable(text: str) -> str:
    """Return ``text`` with every character that cannot be shown written as an escape.

    What remains is valid in any XML or HTML document and can be encoded. Line breaks and tabs
    are kept.
    """
    if text.isascii() and text.isprintable():
        return text
    return "".join(c if _is_shown(c) else _escape(c) for c in text)


def _is_shown(character: str) -> bool:
    if character in KEPT:
        return True
    return unicodedata.category(character) not in HIDDEN and character not in TURNING


def _escape(character: str) -> str:
    code = ord(character)
    if code < 0x100:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def needs_jinja(page: str) -> None:
    """Raise InputError where the package that fills in ``page`` is not installed."""
    if find_spec("jinja2") is None:
        raise missing_extra(f"{page} needs Jinja", "conformance")


def fill_template(template: str, package: str = __package__, **values: Any) -> str:
    """Return the page that ``template`` makes of ``values``; every string in it is escaped.

    It lies in the folder ``templates`` of ``package``, beside those of this one that it extends.
    """
    from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=ChoiceLoader([PackageLoader(name) for name in (package, __package__)]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=_in_page,
    )
    return environment.get_template(template).render(**values) + "\n"


def _in_page(value: Any) -> Any:
    """Return ``value`` with what cannot be shown in a string escaped; markup is sound already."""
    return printable(value) if type(value) is str else value
