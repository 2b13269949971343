"""Templates filled in: what a device or a file said is text in a page, never markup."""

from importlib.util import find_spec
from typing import Any

from floatref.errors import InputError
from floatref_conformance.render.text import printable


def needs_jinja(page: str) -> None:
    """Raise InputError where the package that fills in ``page`` is not installed."""
    if find_spec("jinja2") is None:
        raise InputError(f"{page} needs Jinja; pip install 'floatref[conformance]'")


def filled(template: str, **values: Any) -> str:
    """Return the page that ``template`` makes of ``values``; every string in it is escaped."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader(__package__, "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=_shown,
    )
    return environment.get_template(template).render(**values) + "\n"


def _shown(value: Any) -> Any:
    """Return ``value`` with what cannot be shown in a string escaped; markup is sound already."""
    return printable(value) if type(value) is str else value
