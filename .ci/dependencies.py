"""The packages that an installation brings along, and their licences, from the installed metadata.

python .ci/dependencies.py           # print every one, with the extra that asks for it
python .ci/dependencies.py --write   # renew the table of docs/dependencies.md
"""

import re
import sys
from collections.abc import Iterator
from importlib.metadata import PackageMetadata, PackageNotFoundError, metadata, requires
from pathlib import Path
from typing import NamedTuple

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

EXTRAS = ("plot", "adapters", "conformance", "batch", "gis")
"""The extras of users; `dev` is for work on floatref itself."""
PAGE = Path(__file__).parents[1] / "docs" / "dependencies.md"
BEGIN, END = "<!-- dependencies -->\n", "<!-- /dependencies -->"
FAMILIES = {
    "Apache-2.0": r"Apache",
    "BSD": r"BSD",
    "MIT": r"\bMIT\b",
    "PSF": r"PSF|Python Software Foundation",
    "MPL-2.0": r"MPL|Mozilla",
    "LGPL-3.0": r"LGPL|Lesser General Public",
    "ISC": r"\bISC",
    "other": r"Unlicense|CC0|Zlib",
}
"""Licences under which a library may be used beside Apache-2.0, by what their names contain."""


class Dependency(NamedTuple):
    """One package, and the extras that bring it along; "" is the installation itself."""

    name: str
    extras: tuple[str, ...]


def list_asked() -> list[Dependency]:
    """Return the packages that floatref asks for itself, by name."""
    return _by_name({extra: _own(extra) for extra in ("", *EXTRAS)})


def list_all() -> list[Dependency]:
    """Return every package that an installation with all extras of users needs, by name."""
    return _by_name({extra: _closure(_own(extra)) for extra in ("", *EXTRAS)})


def licence_of(name: str) -> str:
    """Return the family of the licence that the installed package states, "" for an unknown one."""
    return family(stated(metadata(name)))


def stated(about: PackageMetadata) -> str:
    """Return what a package says of its licence: an expression, else classifiers, else text."""
    (expression,) = about.get_all("License-Expression") or [""]
    if expression:
        return str(expression)
    classified = [line for line in about.get_all("Classifier") or [] if line.startswith("License")]
    return (
        " AND ".join(line.rpartition(" :: ")[2] for line in classified)
        or " ".join(about.get_all("License") or [])[:80]
    )


def family(licence: str) -> str:
    """Return the first family of ``licence``, "" where a licence that also binds has no family."""
    found = [_family(part) for part in re.split(r"\bAND\b", licence)]
    return found[0] if all(found) else ""


def table() -> str:
    """Return the table of the packages that floatref asks for itself."""
    rows = ["| package | comes with | licence |", "|---|---|---|"]
    for each in list_asked():
        extras = ", ".join(f"`{extra}`" if extra else "floatref" for extra in each.extras)
        rows.append(f"| {each.name} | {extras} | {licence_of(each.name)} |")
    return "\n".join(rows) + "\n"


def _family(licence: str) -> str:
    """Return the family of one licence, or of the first that may be chosen."""
    matching = (name for name, pattern in FAMILIES.items() if re.search(pattern, licence))
    return next(matching, "")


def _own(extra: str) -> set[str]:
    """Return what floatref asks for with ``extra``, without what every installation has."""
    base = {name for name, _ in _needed("floatref", set())}
    return {name for name, _ in _needed("floatref", {extra})} - (base if extra else set())


def _by_name(asked: dict[str, set[str]]) -> list[Dependency]:
    """Return each package once, with the extras of ``asked`` that bring it along."""
    names = sorted(set().union(*asked.values()))
    return [Dependency(name, tuple(x for x, own in asked.items() if name in own)) for name in names]


def _closure(names: set[str]) -> set[str]:
    """Return ``names`` and all that they need in turn."""
    waiting = [(name, frozenset[str]()) for name in names]
    seen = set(waiting)
    while waiting:
        for one in _needed(*waiting.pop()):
            if one not in seen:
                seen.add(one)
                waiting.append(one)
    return {name for name, _ in seen}


def _needed(name: str, extras: set[str] | frozenset[str]) -> Iterator[tuple[str, frozenset[str]]]:
    """Yield what an installed package needs on this platform, each with the extras it asks for."""
    try:
        lines = requires(name) or []
    except PackageNotFoundError:
        # Where another platform needs it, it is listed there.
        return
    for line in lines:
        need = Requirement(line)
        chosen = [{"extra": extra} for extra in extras or {""}]
        if need.marker is None or any(need.marker.evaluate(each) for each in chosen):
            yield canonicalize_name(need.name), frozenset(need.extras)


def main() -> None:
    """Print all packages, or write those that floatref asks for into the page."""
    if "--write" in sys.argv[1:]:
        before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
        PAGE.write_text(before + BEGIN + table() + END + rest.partition(END)[2], encoding="utf-8")
        return
    for each in list_all():
        print(f"{each.name:28} {licence_of(each.name) or '?':12} {' '.join(each.extras)}")


if __name__ == "__main__":
    main()
