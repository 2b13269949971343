"""Fifty kills at random moments of `floatref`; `kill.py` draws more, and those of the judge.

Law: what was written is whole or not there, nothing goes on, and nothing is left after the next
run of the same command.
"""

import random
from dataclasses import replace
from pathlib import Path

import click
import pytest
from tests.hostile.attack import warm_up, warm_words
from tests.hostile.attacked_commands import conformance, floatref
from tests.hostile.hostile_files import write_sound
from tests.hostile.kill import Place, Work, kill_once, measure_works
from tests.hostile.killed_commands import KILLED, NOT_KILLED, write_working

pytestmark = pytest.mark.posix
Made = tuple[Path, dict[str, Path], list[Work]]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Made:
    """A folder, the sound files in it, and the commands, each run to its end."""
    folder = tmp_path_factory.mktemp("kills")
    (folder / "sound").mkdir()
    sound = write_sound(folder / "sound") | write_working(folder / "sound")
    warm_up(warm_words(folder, sound))
    return folder, sound, measure_works(folder, sound, "floatref")


def test_every_command_is_killed_or_has_its_reason() -> None:
    """A new command fails here until it is in a list."""
    commands = {
        f"{program} {name}"
        for program, group in (("floatref", floatref), ("conformance", conformance))
        for name in group.list_commands(click.Context(group))
    }
    killed = {" ".join(key.split()[:2]) for key in KILLED}
    assert killed | set(NOT_KILLED) == commands
    assert not killed & set(NOT_KILLED)


@pytest.mark.parametrize(
    ("found", "exact", "stamped"),
    [
        (b'{"s": 1.5}\n', True, True),
        (b'{"s": 12.25}\n', False, True),
        (b'{"s": 1.5}', False, False),
        (b'{"s": 1', False, False),
        (b"", False, False),
    ],
)
def test_whole_is_what_has_all_bytes_or_all_but_numbers(
    tmp_path: Path, found: bytes, exact: bool, stamped: bool
) -> None:
    place = Place(tmp_path)
    place.target.write_bytes(b'{"s": 1.5}\n')
    work = Work("a command", "", 0, place.files(), frozenset(), 1.0)
    place.target.write_bytes(found)
    assert work.wrote(place.files()) == exact
    assert replace(work, stamped=frozenset({"target"})).wrote(place.files()) == stamped
    assert not work.wrote({})
    assert work.wrote({}, whole=False)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(10))
def test_a_kill_leaves_what_is_whole_and_nothing_else(made: Made, part: int) -> None:
    folder, sound, works = made
    assert len(works) >= 20
    for number in range(5):
        work = works[(5 * part + number) % len(works)]
        killed = kill_once(work, folder, sound, random.Random())
        assert killed.faults == (), killed
