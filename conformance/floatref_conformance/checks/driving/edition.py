"""The driving checks as data of the edition, from `edition.toml`: rows, limits, roads and words."""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

Table = Mapping[str, Any]


@cache
def edition() -> Table:
    """Return the whole document; it keeps schema ``conformance-driving-1``."""
    text = (files(__package__) / "edition.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def derivation_of(check: Table) -> str:
    """Return how the cases of ``check`` are made, and why its limits are what they are."""
    return str(check["derivation"]).format_map(_texts())


def floor_of(check: Table) -> str:
    """Return what must be in a profile: the bump, where ``check`` has it."""
    return str(edition()["floor"]["text"]).format(where=check["bump"], slow=check.get("slow", ""))


@cache
def _texts() -> Mapping[str, str]:
    """Return the texts that derivations share, each with those above it filled in."""
    texts: dict[str, str] = {}
    for name, text in edition()["texts"].items():
        texts[name] = text.format_map(texts)
    return texts
