"""Which images and commands are taken; everything else is one line and exit code 2."""

import re

import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.conformance.devices.containers.conftest import DIGEST, IMAGE

from floatref.errors import InputError
from floatref_conformance.cli.main import main
from floatref_conformance.devices.containers.container_device import make
from floatref_conformance.devices.containers.engine import check_image

pytestmark = pytest.mark.posix
BAD = ("-v", "--volume=/:/host", "a b", "a\nb", "a\x1b[31m", "a;b", "a$(b)", "é", "x" * 300)


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_name_of_an_image_is_one_line_and_starts_nothing(podman, name):
    stub = podman("")
    ended = CliRunner().invoke(main, ["run", "--device", f"container:{name}"])
    assert (ended.exit_code, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert "no name of an image" in ended.stderr
    assert ended.stderr[:-1].isprintable()
    assert len(ended.stderr) < 400
    assert stub.calls == []


@settings(max_examples=50, deadline=None)
@given(st.text(st.sampled_from("aZ09.-_/:@+ ;$=\\\n\x1bé"), max_size=12))
def test_a_name_that_is_taken_is_no_option_and_one_word(name):
    try:
        check_image(name)
    except InputError:
        return
    assert re.fullmatch(r"[!-,.-~][!-~]*", name)
    assert not re.search(r"[\s$;&|<>`'\"\\(){}*?,=]", name)


@pytest.mark.parametrize("name", ["firmware", "vendor/fw:1.2", f"host:5000/a/b@sha256:{'0' * 64}"])
def test_usual_names_are_taken(name):
    check_image(name)


def test_an_image_that_is_not_here_is_refused_with_what_to_do(podman):
    podman("")
    with pytest.raises(InputError, match=r"Error: other:1: image not known.*`podman pull`"):
        make("other:1")


def other_command(path, has_it):
    """Write a docker that knows IMAGE, or refuses it."""
    answer = f"echo {'a7' * 32}" if has_it else "echo unknown to docker >&2; exit 1"
    path.write_text(f'#!/bin/sh\n[ "$1" = image ] || exit 0\n{answer}\n', encoding="utf-8")
    path.chmod(0o755)


def test_an_image_that_the_other_command_has_is_run_by_it(podman):
    stub = podman("")
    other_command(stub.folder / "docker", True)
    theirs, ours = make("built-by-docker:1"), make(IMAGE)
    assert (theirs.engine.name, theirs.digest) == ("docker", "a7" * 32)
    assert (ours.engine.name, ours.digest) == ("podman", DIGEST)


def test_an_image_that_no_command_has_is_refused_by_each(podman):
    stub = podman("")
    other_command(stub.folder / "docker", False)
    with pytest.raises(InputError, match=r"podman finds no such.*docker finds no such") as caught:
        make("other:1")
    assert "\n" not in str(caught.value)


def test_without_a_command_it_is_named_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    ended = CliRunner().invoke(main, ["run", "--device", f"container:{IMAGE}"])
    assert (ended.exit_code, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert "neither podman nor docker is found; install one of them" in ended.stderr
