"""The page on commands shows the help of every command, and the site the public names."""

import re
from pathlib import Path

import click
import pytest

import floatref
from floatref.cli.main import main as floatref_command
from floatref_conformance.cli.main import main as conformance_command

DOCS = Path(__file__).parents[2] / "docs"
SHOWN = re.findall(
    r"^<!-- help: (.+) -->$", (DOCS / "commands.md").read_text(encoding="utf-8"), re.M
)


@pytest.mark.parametrize(
    ("name", "group"), [("floatref", floatref_command), ("conformance", conformance_command)]
)
def test_every_command_is_shown(name: str, group: click.Group) -> None:
    names = [f"{name} {command}" for command in group.list_commands(click.Context(group))]
    assert [shown for shown in SHOWN if shown.split()[0] == name] == [name, *names]


def test_every_public_name_is_in_the_api() -> None:
    page = (DOCS / "api" / "index.md").read_text(encoding="utf-8")
    for name in floatref.__all__:
        assert name == "__version__" or f"[`{name}`][floatref." in page, name


def test_every_decision_is_listed_and_in_the_site() -> None:
    index = (DOCS / "decisions" / "index.md").read_text(encoding="utf-8")
    site = (DOCS.parent / ".mkdocs.yml").read_text(encoding="utf-8")
    for record in (DOCS / "decisions").glob("0*.md"):
        assert f"({record.name})" in index
        assert f"decisions/{record.name}" in site
