"""The runs of `tests/sdk/live`, for the command."""

import importlib.util
from pathlib import Path

import pytest

LIVE = Path(__file__).parents[2] / "live"


def load(name, path):
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


RUNS = load("runs_of_live", LIVE / "conftest.py")
SESSION = load("messages_of_live", LIVE / "session" / "conftest.py")


@pytest.fixture(scope="session")
def drive():
    return RUNS.make_drive


@pytest.fixture(scope="session")
def same():
    return RUNS.assert_same


@pytest.fixture(scope="session")
def messages_of():
    return SESSION.messages_of


@pytest.fixture(scope="session")
def as_lines():
    return SESSION.as_lines
