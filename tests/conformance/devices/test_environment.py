"""A device gets the variables that programs need and those asked for, and no others."""

import json
import os
import sys
from pathlib import Path

import pytest

from floatref.errors import InputError
from floatref_conformance.devices.environment import check_variables, environment_of
from floatref_conformance.devices.process import start

SHOW = "import json, os; print(json.dumps(dict(os.environ)), flush=True); input()"
SECRETS = ("BUILD_PASSWORD", "AWS_SECRET_ACCESS_KEY", "SSH_AUTH_SOCK", "PATHOLOGY", "MY_PATH")
USUAL = ("PATH", "HOME", "LC_ALL", "TMPDIR", "PYTHONPATH", "OMP_NUM_THREADS", "SystemRoot")


@pytest.fixture(autouse=True)
def full_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FLOATREF_CACHE", "/the/truth")
    for name in SECRETS:
        monkeypatch.setenv(name, "secret")
    for name in USUAL:
        monkeypatch.setenv(name, os.environ.get(name, "usual"))


def test_only_what_programs_need_is_passed_on() -> None:
    given = environment_of()
    assert set(USUAL) <= set(given)
    assert not {*SECRETS, "FLOATREF_CACHE"} & set(given)


def test_a_variable_is_added_by_its_name() -> None:
    assert set(environment_of(SECRETS[:1])) - set(environment_of()) == {SECRETS[0]}
    assert "FLOATREF_CACHE" not in environment_of(["FLOATREF_CACHE"])


@pytest.mark.parametrize("name", ["FLOATREF_CACHE", "NOT_SET_ANYWHERE"])
def test_what_cannot_be_passed_on_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=f"--env {name}: .*; .*leave it out"):
        check_variables([name])


def test_a_started_device_finds_just_these(tmp_path: Path) -> None:
    child = start([sys.executable, "-c", SHOW], tmp_path, SECRETS[1:2])
    try:
        given = json.loads(child.receive(600.0))
    finally:
        child.kill()
    assert given.pop("FLOATREF_DEVICE")
    # Python sets the language of its own process.
    given.pop("LC_CTYPE", None)
    expected = environment_of(SECRETS[1:2])
    expected.pop("LC_CTYPE", None)
    assert given == expected
