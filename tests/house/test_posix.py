"""Tests run anywhere: what needs more than Windows has carries a mark that leaves it out there.

Law: a file of tests that names links, pipes, /proc, a shell or a signal of POSIX has the mark
`posix`, a `skipif` or an `importorskip`. Text is read and written with its encoding.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
OF_POSIX = re.compile(
    r"fcntl|import resource|os\.fork|os\.kill|SIGKILL|symlink_to|os\.symlink|preexec_fn|"
    r"start_new_session|[\"']/proc|/dev/(null|full|zero)|mkfifo|\bchmod\(|[\"'](bash|sh)[\"']|geteuid"
)
LEAVES_OUT = ("posix", "skipif", "importorskip")
TESTS = sorted(ROOT.glob("tests/**/test_*.py"))
CODE = sorted(
    path
    for room in ("sdk", "adapters", "reference_impl", "conformance")
    for path in (ROOT / room).rglob("*.py")
)


def test_what_windows_lacks_is_marked() -> None:
    unmarked = []
    for path in TESTS:
        text = path.read_text(encoding="utf-8")
        if OF_POSIX.search(text) and not any(word in text for word in LEAVES_OUT):
            unmarked.append(path.relative_to(ROOT).as_posix())
    assert not unmarked


@pytest.mark.slow
def test_code_never_takes_the_encoding_of_the_system() -> None:
    wrong = []
    for path in CODE:
        text = path.read_text(encoding="utf-8")
        if not re.search(r"open\(|_text\(", text):
            continue
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Call) and _takes_text(node):
                wrong.append(f"{path.relative_to(ROOT)}:{node.lineno}")
    assert not wrong


def _takes_text(call: ast.Call) -> bool:
    """Return whether ``call`` reads or writes text and names no encoding."""
    name = getattr(call.func, "attr", getattr(call.func, "id", ""))
    named = {keyword.arg for keyword in call.keywords}
    if name in ("read_text", "write_text"):
        # `importlib.resources` has them too; there the encoding is the first argument.
        return "encoding" not in named and not (name == "read_text" and call.args)
    if name != "open" or (isinstance(call.func, ast.Attribute) and not _is_path(call.func)):
        return False
    modes = [a.value for a in call.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]
    return "encoding" not in named and not any("b" in mode for mode in modes) and bool(modes)


def _is_path(function: ast.Attribute) -> bool:
    """Return whether the `open` of a path is meant, as far as its name tells."""
    return isinstance(function.value, ast.Name) and function.value.id in ("path", "file", "beside")
