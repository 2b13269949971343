"""What is read in another process is what is read in this one, or it is refused in one line."""

import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError, read_apart

BROKEN = "run.xyz: no sound file"


@pytest.fixture(autouse=True, scope="module")
def importable() -> Iterator[None]:
    """Let other processes import this module, of which they run functions."""
    root = str(Path(__file__).parents[3])
    sys.path.insert(0, root)
    yield
    sys.path.remove(root)


def pieces(values: list[float]) -> Iterator[object]:
    for value in values:
        yield np.array([value])
        yield {"value": value}


def refuse(name: str) -> Iterator[object]:
    yield 1
    raise InputError(f"{name}: a hole at 3 m")


def break_down(how: str) -> Iterator[object]:
    yield 1
    if how == "abort":
        os.abort()
    if how == "leave":
        os._exit(0)
    if how == "other":
        raise ValueError("of the library")
    if how == "print":
        sys.stdout.buffer.write(b"not an answer")
        sys.stdout.flush()
    if how == "swell":
        yield np.ones(1 << 27).size
    time.sleep(60)
    yield 2


def count_on(path: str) -> Iterator[object]:
    for k in range(1_000_000):
        yield k
        Path(path).write_text(str(os.getpid()))


def name(function: object) -> str:
    return f"{__name__}:{function.__name__}"  # type: ignore[attr-defined]


@settings(deadline=None, max_examples=5)
@given(st.lists(st.floats(allow_nan=False), max_size=4))
def test_it_yields_what_the_function_yields(values: list[float]) -> None:
    assert list(read_apart(name(pieces), (values,), BROKEN)) == list(pieces(values))


def test_an_error_of_the_input_has_its_own_text_and_comes_behind_what_was_read() -> None:
    answers = read_apart(name(refuse), ("road.xyz",), BROKEN)
    assert next(answers) == 1
    with pytest.raises(InputError, match=r"^road\.xyz: a hole at 3 m$"):
        next(answers)


@pytest.mark.parametrize("how", ["abort", "leave", "other", "print", "hang", "swell"])
def test_a_function_that_breaks_down_does_no_harm(how: str) -> None:
    silence_s = 0.5 if how == "hang" else None
    answers = read_apart(name(break_down), (how,), BROKEN, silence_s, most_memory=1 << 29)
    assert next(answers) == 1
    with pytest.raises(InputError, match=rf"^{BROKEN}$"):
        next(answers)


def test_one_that_does_not_exist_is_refused() -> None:
    with pytest.raises(InputError, match=rf"^{BROKEN}$"):
        list(read_apart(f"{__name__}:nothing", (), BROKEN))


def test_a_reader_that_is_left_early_leaves_no_process(tmp_path: Path) -> None:
    path = tmp_path / "number"
    answers = read_apart(name(count_on), (str(path),), BROKEN)
    assert [next(answers), next(answers)] == [0, 1]
    answers.close()  # type: ignore[attr-defined]
    with pytest.raises(ProcessLookupError):
        os.kill(int(path.read_text()), 0)
