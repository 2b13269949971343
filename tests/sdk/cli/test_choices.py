"""Every command and option that takes a name says which one was meant."""

from pathlib import Path
from typing import Any

import click
import pytest
from click.testing import CliRunner

from floatref.cli.choices import OneOf
from floatref.cli.lazy import LazyGroup
from floatref.cli.main import main
from floatref_conformance.cli.main import main as conformance

GROUPS = {"floatref": main, "conformance": conformance}
COMMANDS = [(group, name) for group, found in GROUPS.items() for name in found.list_commands(None)]


def refused(group: LazyGroup, *words: str) -> str:
    done = CliRunner().invoke(group, list(words))
    assert (done.exit_code, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1
    return str(done.stderr)


@pytest.mark.parametrize(("group", "name"), COMMANDS)
def test_a_mistyped_command_is_refused_with_the_one_that_was_meant(group: str, name: str) -> None:
    typed = f"{name[:-1]}{name[-1] * 3}"
    assert refused(GROUPS[group], typed).endswith(f"{typed}'. Did you mean {name}?\n")


def options_of(group: str, name: str) -> list[Any]:
    command = GROUPS[group].get_command(click.Context(GROUPS[group]), name)
    assert command is not None
    return [option for option in command.params if isinstance(option.type, click.Choice)]


@pytest.mark.parametrize(("group", "name"), COMMANDS)
def test_a_mistyped_choice_is_refused_with_the_one_that_was_meant(group: str, name: str) -> None:
    for option in options_of(group, name):
        assert isinstance(option.type, OneOf)
        meant = next(str(each) for each in option.type.choices if len(str(each)) > 1)
        typed = f"{meant}x"
        is_argument = isinstance(option, click.Argument)
        words = [typed] if is_argument else [option.opts[0], typed]
        line = refused(GROUPS[group], name, *words)
        assert f"'{typed}' is not one of" in line
        assert "Did you mean" in line
        assert (option.human_readable_name if is_argument else option.opts[0]) in line


def test_a_command_like_no_other_has_no_hint() -> None:
    assert refused(main, "zzz") == "Error: No such command 'zzz'.\n"


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        (["--pipeline", "temporal-basc"], "temporal-basic"),
        (["--adapter", "recordng"], "recording"),
        (["--format", "profil"], "profile"),
    ],
)
def test_process_knows_what_was_meant(steady, tmp_path: Path, words: list[str], meant: str) -> None:
    from floatref.files import write_recording

    write_recording(steady(), tmp_path / "run")
    out = tmp_path / "out"
    line = refused(main, "process", str(tmp_path / "run"), "--out", str(out), *words)
    assert f"id you mean {meant}?" in line
    assert not out.exists()
