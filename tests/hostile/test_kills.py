"""Fifty kills at random moments of `floatref`; `kill.py` draws more, and those of the judge.

Law: what was written is whole or not there, nothing goes on, and nothing is left after the next
run of the same command.
"""

import random
from pathlib import Path

import pytest
from tests.hostile.attack import warm_up, warm_words
from tests.hostile.hostile_files import write_sound
from tests.hostile.kill import Work, kill_once, measure_works

pytestmark = [pytest.mark.posix, pytest.mark.slow]
Made = tuple[Path, dict[str, Path], list[Work]]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Made:
    """A folder, the sound files in it, and the commands that write, each run once to its end."""
    folder = tmp_path_factory.mktemp("kills")
    (folder / "sound").mkdir()
    sound = write_sound(folder / "sound")
    warm_up(warm_words(folder, sound))
    return folder, sound, measure_works(folder, sound, "floatref")


@pytest.mark.parametrize("part", range(10))
def test_a_kill_leaves_what_is_whole_and_nothing_else(made: Made, part: int) -> None:
    folder, sound, works = made
    assert len(works) >= 7
    for number in range(5):
        work = works[(5 * part + number) % len(works)]
        killed = kill_once(work, folder, sound, random.Random())
        assert killed.faults == (), killed
