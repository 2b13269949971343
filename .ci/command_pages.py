"""MkDocs hook: a line `<!-- help: floatref process -->` becomes that command's help."""

import re

import click

from floatref.cli.main import main as floatref
from floatref_conformance.cli.main import main as conformance

GROUPS = {"floatref": floatref, "conformance": conformance}
MARK = re.compile(r"^<!-- help: (\w+) ?(\w*) -->$", re.MULTILINE)


def on_page_markdown(markdown: str, **_: object) -> str:
    """Return ``markdown`` with the help of every command that it asks for."""
    return MARK.sub(lambda found: f"```text\n{help_of(*found.groups())}\n```", markdown)


def help_of(group: str, name: str) -> str:
    """Return what ``group name --help`` prints; ``name`` may be empty."""
    context = click.Context(GROUPS[group], info_name=group, max_content_width=88)
    if not name:
        return context.get_help()
    command = GROUPS[group].get_command(context, name)
    if command is None:
        raise KeyError(f"{group} has no command {name}")
    return click.Context(command, info_name=name, parent=context, max_content_width=88).get_help()
