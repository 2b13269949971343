"""How the tests call a command, and an adapter that they know."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from click.testing import CliRunner, Result

from floatref.cli.main import main


@pytest.fixture(scope="session")
def invoke() -> Callable[..., Result]:
    """Return what calls a command with arguments of any kind."""
    return lambda *arguments: CliRunner().invoke(main, [str(a) for a in arguments])


@pytest.fixture(scope="session")
def ran(invoke: Callable[..., Result]) -> Callable[..., Result]:
    """Return what calls a command that has to succeed."""

    def call(*arguments: object) -> Result:
        result = invoke(*arguments)
        assert result.exit_code == 0, result.output
        return result

    return call


@pytest.fixture(scope="session")
def reported(ran: Callable[..., Result]) -> Callable[..., dict[str, Any]]:
    """Return what calls a command for its JSON."""
    return lambda *arguments: json.loads(ran(*arguments, "--json").stdout)


@pytest.fixture(scope="session")
def refused(invoke: Callable[..., Result]) -> Callable[..., str]:
    """Return what calls a command for the one line of its refusal."""

    def call(*arguments: object) -> str:
        result = invoke(*arguments)
        assert (result.exit_code, result.stdout) == (2, "")
        assert "Traceback" not in result.stderr
        assert result.stderr.strip().count("\n") == 0
        return str(result.stderr)

    return call
