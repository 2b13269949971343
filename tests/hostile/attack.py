"""Attack every command with hostile files, and print counts: how to run it is in the threat model.

Every kind of what is no file stands in every place where a command reads or writes; damaged native
files and names with controls go through those that read any file. Exit code 1 if anything hung,
crashed, printed a traceback, took more than 600 MiB or left a file or a process behind.
"""

import argparse
import random
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.hostile.attack_running import Ended, run_attack, warm_up
from tests.hostile.attacked_commands import READ, WRITTEN
from tests.hostile.hostile_files import (
    CONTROLS,
    IN_PLACE_OF_A_TARGET,
    KINDS,
    damage,
    write_sound,
)

NATIVE = ("channels {x}", "convert {x} --out {out}.csv", "allan {x}", "process {x} --out {out}")
"""Commands that read any native file."""


def words_of(key: str, template: str, hostile: Path, sound: dict[str, Path]) -> list[str]:
    """Return the words of the command at ``key`` with ``hostile`` in its place."""
    places = {name: str(path) for name, path in sound.items()}
    places |= {"x": str(hostile), "out": str(hostile.with_name("out"))}
    return [key.split()[0], *(word.format(**places) for word in template.split())]


def warm_words(folder: Path, sound: dict[str, Path]) -> Iterator[list[str]]:
    """Yield the words of commands that import what all of them need."""
    place = folder / "warm"
    place.mkdir()
    for key, template in READ.items():
        yield words_of(key, template, place / "missing", sound)
    for number, template in enumerate(NATIVE):
        (place / str(number)).mkdir()
        yield words_of("floatref", template.replace("{x}", "{csv}"), place / f"{number}/x", sound)
    yield words_of("floatref", "iri {profile}", place / "x", sound)


def suffix_in(template: str) -> str:
    """Return the suffix that a command expects of a hostile file, "" without one."""
    behind = template.partition("{x}")[2].split(" ")[0]
    return behind if behind.startswith(".") else ""


def attack_places(folder: Path, sound: dict[str, Path]) -> Iterator[tuple[str, list[str]]]:
    """Yield class and words of every attack in which no file, or no sound one, is in a place."""
    for kind, make in KINDS.items():
        targets = WRITTEN if kind in IN_PLACE_OF_A_TARGET else {}
        for key, template in (READ | targets).items():
            place = Path(tempfile.mkdtemp(dir=folder))
            make(place / f"hostile{suffix_in(template)}")
            yield kind, words_of(key, template, place / "hostile", sound)
            shutil.rmtree(place, ignore_errors=True)


def attack_natives(
    folder: Path, sound: dict[str, Path], count: int, draw: random.Random
) -> Iterator[tuple[str, list[str]]]:
    """Yield class and words of ``count`` attacks with damaged native files."""
    natives = sorted(p for p in sound["run"].parent.glob("native*") if p.is_file())
    for _ in range(count):
        native = draw.choice([*natives, sound["csv"], sound["can"]])
        how, content = damage(native.read_bytes(), draw)
        place = Path(tempfile.mkdtemp(dir=folder))
        name = CONTROLS if draw.random() < 0.1 else "hostile"
        hostile = place / f"{name}{native.suffix}"
        hostile.write_bytes(content)
        words = words_of("floatref", draw.choice(NATIVE), hostile, sound)
        yield f"{how} {native.suffix}", words
        shutil.rmtree(place, ignore_errors=True)


def report(ended: list[tuple[str, Ended]]) -> int:
    """Print counts, and every command with a fault; return how many these are."""
    faults = Counter(fault for _, one in ended for fault in one.faults())
    for kind, count in sorted(Counter(kind for kind, _ in ended).items()):
        print(f"{count:6} {kind}")
    for kind, one in ended:
        if one.faults():
            last = one.text.strip().splitlines()[-1:] or [""]
            print(f"{', '.join(one.faults())}: {kind}: {' '.join(one.words)!a}: {last[0]!a}")
    largest = max((one.peak_bytes for _, one in ended), default=0)
    names = ("hang", "crash", "traceback", "controls", "left behind", "memory")
    print(f"{len(ended)} attacks:", ", ".join(f"{faults[name]} {name}" for name in names))
    print(f"largest memory {largest / 2**20:.0f} MiB")
    return sum(bool(one.faults()) for _, one in ended)


def main() -> None:
    """Attack as often as the arguments say."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--natives", type=int, default=1000, help="damaged native files")
    parser.add_argument("--seed", type=int, default=None)
    given = parser.parse_args()
    draw = random.Random(given.seed)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "sound").mkdir()
        sound = write_sound(folder / "sound")
        warm_up(warm_words(folder, sound))
        attacks = attack_places(folder, sound)
        natives = attack_natives(folder, sound, given.natives, draw)
        ended = [(k, run_attack(w, folder)) for each in (attacks, natives) for k, w in each]
        sys.exit(1 if report(ended) else 0)


if __name__ == "__main__":
    main()
