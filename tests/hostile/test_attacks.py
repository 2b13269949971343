"""Hostile files in every place where a command reads or writes: one line, and nothing left behind.

Law: whatever stands in place of a file, a command ends by itself with exit code 2 or another of its
own, prints one line and no traceback, and takes a bounded share of memory. `attack.py` draws more.
"""

import random
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.hostile.attack import attack_natives, suffix_in, warm_up, warm_words, words_of
from tests.hostile.attack_running import TRACES, Ended, run_attack
from tests.hostile.attacked_commands import (
    ELSEWHERE,
    READ,
    TEXTS,
    WRITTEN,
    floatref,
    named_places,
)
from tests.hostile.attacked_commands import conformance as judge
from tests.hostile.hostile_files import KINDS, write_sound

pytestmark = pytest.mark.posix
LONGEST_S = 300
"""A wait that long is one for ever, on a busy machine too."""
APART = "conformance certify"
"""Runs its commands in processes of their own, each of which imports everything."""


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The sound files that the words of the commands name."""
    return write_sound(tmp_path_factory.mktemp("sound"))


@pytest.fixture(autouse=True)
def no_wait_for_ever() -> Iterator[None]:
    """End a test that waits for a pipe."""

    def end(number: int, frame: object) -> None:
        raise TimeoutError("a command waits for ever")

    before = signal.signal(signal.SIGALRM, end)
    signal.alarm(LONGEST_S)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def test_every_place_of_every_command_is_attacked() -> None:
    """A new command, or a new option with a path, fails here until it is in a list."""
    attacked = (set(READ) | set(WRITTEN)) - TEXTS
    others = {name for name in named_places() if name.startswith(tuple(ELSEWHERE))}
    assert others
    assert attacked == set(named_places()) - others


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["pipe", "loop"])
@pytest.mark.parametrize("key", [key for key in READ if not key.startswith(APART)])
def test_what_is_no_file_is_refused_in_one_line(
    tmp_path: Path, sound: dict[str, Path], key: str, kind: str
) -> None:
    hostile = tmp_path / f"hostile{suffix_in(READ[key])}"
    KINDS[kind](hostile)
    words = words_of(key, READ[key], tmp_path / "hostile", sound)
    ended = CliRunner().invoke(judge if words[0] == "conformance" else floatref, words[1:])
    assert ended.exit_code == 2, ended.output
    (line,) = [line for line in ended.output.splitlines() if "Error: " in line]
    assert str(hostile) in line
    assert not any(trace in ended.output for trace in TRACES)
    assert sorted(path.name for path in tmp_path.iterdir()) == [hostile.name]


@pytest.mark.parametrize("kind", ["pipe", "loop"])
@pytest.mark.parametrize("key", WRITTEN)
def test_a_target_that_is_no_file_is_refused_in_one_line(
    tmp_path: Path, sound: dict[str, Path], key: str, kind: str
) -> None:
    hostile = tmp_path / f"hostile{suffix_in(WRITTEN[key])}"
    KINDS[kind](hostile)
    words = words_of(key, WRITTEN[key], tmp_path / "hostile", sound)
    ended = CliRunner().invoke(judge if words[0] == "conformance" else floatref, words[1:])
    assert ended.exit_code == 2, ended.output
    assert str(hostile) in ended.output
    assert not any(trace in ended.output for trace in TRACES)
    assert sorted(path.name for path in tmp_path.iterdir()) == [hostile.name]


@pytest.mark.parametrize("kind", ["pipe", "loop"])
def test_a_case_that_a_device_planted_is_refused(tmp_path: Path, kind: str) -> None:
    """`conformance run --report` replays the cases of the folder, where devices can write."""
    (tmp_path / "cases").mkdir()
    KINDS[kind](tmp_path / "cases" / "stop-00000000.json")
    words = ["run", "--check", "stop", "--device", "builtin:temporal-basic"]
    ended = CliRunner().invoke(judge, [*words, "--report", str(tmp_path)])
    assert ended.exit_code == 2, ended.output
    assert "stop-00000000.json: " in ended.output


def faulty(ended: list[Ended]) -> list[str]:
    """Return what is wrong with the commands that ended."""
    return [f"{one.faults()}: {one.words}: {one.text[-300:]}" for one in ended if one.faults()]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="memory is counted in KiB there alone")
def test_damaged_native_files_leave_nothing(tmp_path: Path, sound: dict[str, Path]) -> None:
    draw = random.Random()
    warm_up(warm_words(tmp_path, sound))
    attacks = attack_natives(tmp_path, sound, 40, draw)
    assert not faulty([run_attack(words, tmp_path) for _, words in attacks])
