"""Fifty kills at random moments of `floatref`; `kill.py` draws more, and those of the judge.

Law: what was written is whole or not there, nothing goes on, and nothing is left after the next
run of the same command.
"""

import random
from pathlib import Path

import click
import pytest
from tests.hostile.attack import warm_up, warm_words
from tests.hostile.attacked_commands import conformance, floatref
from tests.hostile.hostile_files import write_sound
from tests.hostile.kill import Work, kill_once, measure_works
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


@pytest.mark.slow
@pytest.mark.parametrize("part", range(10))
def test_a_kill_leaves_what_is_whole_and_nothing_else(made: Made, part: int) -> None:
    folder, sound, works = made
    assert len(works) >= 20
    for number in range(5):
        work = works[(5 * part + number) % len(works)]
        killed = kill_once(work, folder, sound, random.Random())
        assert killed.faults == (), killed
