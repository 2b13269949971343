"""Write many short recordings in every format that holds a whole one, some of them spoilt.

    python tests/benchmarks/batch_corpus.py FOLDER [--files 1000] [--corrupt 10] [--seed 0]

They lie in folders of twenty. `manifest.csv` names them with channel map, pipeline and settings
where they need them, `corrupt.json` those that are spoilt, and how. The same seed writes the same
recordings, whatever the number of processes.
"""

import argparse
import csv
import json
import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType

import numpy as np
from batch_can_logs import CAN_FORMATS, CHART, write_can_log, write_database
from batch_damage import DAMAGES, DIRECTORY, Damage
from batch_drives import drive

from floatref import Recording
from floatref.files import write_recording
from floatref_adapters.testing import WRITERS

SUFFIXES = (DIRECTORY, *WRITERS, *CAN_FORMATS)
PER_FOLDER = 20
PIPELINES = ("", "", "", "", "temporal-hpf", "spatial-basic")
"""What is drawn from; empty: what the command says."""
MANIFEST, CORRUPT = "manifest.csv", "corrupt.json"
MAPPED, SETTINGS = "one-path.toml", "settings.json"
MAP = """format = "floatref-map/1"
[setup]
profile_interval_m = 0.1
[[channels]]
native = "distance"
channel = "distance"
unit = "m"
[[channels]]
native = "main.height"
channel = "height"
unit = "m"
[[channels]]
native = "main.vertical_specific_force"
channel = "vertical_specific_force"
unit = "m/s^2"
"""


@dataclass(frozen=True)
class Item:
    """One file of the corpus: its number, path below the folder, and what else is said of it."""

    number: int
    path: str
    damage: Damage | None = None
    chart: str = ""
    pipeline: str = ""
    settings: str = ""

    @property
    def suffix(self) -> str:
        """Tells the format; empty for a recording directory."""
        return Path(self.path).suffix

    @property
    def row(self) -> Mapping[str, str]:
        said = {"map": self.chart, "pipeline": self.pipeline, "settings": self.settings}
        return MappingProxyType({"file": self.path, **said})


def plan(files: int, corrupt: int, seed: int) -> list[Item]:
    """Return the files of a corpus; every format and every damage in turn, at drawn places."""
    draw = np.random.default_rng([seed, files, corrupt])
    spoilt = draw.permutation(files)[:corrupt].tolist()
    damages = {k: DAMAGES[place % len(DAMAGES)] for place, k in enumerate(spoilt)}
    return [item(draw, number, damages.get(number)) for number in range(files)]


def item(draw: np.random.Generator, number: int, damage: Damage | None) -> Item:
    suffix = SUFFIXES[number % len(SUFFIXES)]
    if damage is not None:
        suffix = str(draw.choice(damage.suffixes))
    path = f"district-{number // PER_FOLDER:02d}/{number:04d}{suffix}"
    in_can = suffix in CAN_FORMATS
    if damage is not None:
        return Item(number, path, damage, CHART if in_can else "")
    mapped = MAPPED if suffix in WRITERS and draw.random() < 0.3 else ""
    pipeline = str(draw.choice(PIPELINES))
    settings = SETTINGS if pipeline and draw.random() < 0.5 else ""
    return Item(number, path, None, CHART if in_can else mapped, pipeline, settings)


def write(entry: Item, folder: Path, seed: int, seconds: float | None) -> None:
    draw = np.random.default_rng([seed, entry.number])
    tracks = ("main",) if entry.chart else None
    in_can = entry.suffix in CAN_FORMATS
    rate = 500 if in_can else None
    recording = drive(draw, seconds, rate, tracks, placed=in_can or entry.number % 4 > 0)
    path = folder / entry.path
    path.parent.mkdir(parents=True, exist_ok=True)
    if entry.damage is not None:
        recording = entry.damage.before(recording)
    writer(entry.suffix)(recording, path)
    if entry.damage is not None:
        entry.damage.after(path)


def writer(suffix: str) -> Callable[[Recording, Path], None]:
    """Return what writes a recording in the format of ``suffix``."""
    if suffix == DIRECTORY:
        return write_recording
    return write_can_log if suffix in CAN_FORMATS else partial(WRITERS[suffix], quanta=None)


def write_corpus(
    folder: Path,
    files: int,
    corrupt: int,
    seed: int = 0,
    seconds: float | None = None,
    jobs: int = 1,
) -> list[Item]:
    """Write a corpus into ``folder``; return what is in it. ``seconds``: of every recording."""
    folder.mkdir(parents=True, exist_ok=True)
    items = plan(files, corrupt, seed)
    write_database(drive(np.random.default_rng(seed), 1.0, 500, ("main",)), folder)
    (folder / MAPPED).write_text(MAP)
    (folder / SETTINGS).write_text('{"interval_m": 0.025}\n')
    doing = partial(write, folder=folder, seed=seed, seconds=seconds)
    if jobs == 1:
        list(map(doing, items))
    else:
        with ProcessPoolExecutor(jobs) as pool:
            list(pool.map(doing, items, chunksize=PER_FOLDER))
    write_manifest(folder / MANIFEST, items)
    named = {entry.path: entry.damage.name for entry in items if entry.damage}
    (folder / CORRUPT).write_text(json.dumps(named, indent=1) + "\n")
    return items


def write_manifest(path: Path, items: Sequence[Item]) -> None:
    """Name the files in a CSV table, as `floatref batch` takes it."""
    with path.open("w", newline="") as stream:
        table = csv.DictWriter(stream, ("file", "map", "pipeline", "settings"))
        table.writeheader()
        table.writerows(entry.row for entry in items)


def main() -> None:
    """Write a corpus from the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--corrupt", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    jobs = os.cpu_count() or 1
    items = write_corpus(given.folder, given.files, given.corrupt, given.seed, jobs=jobs)
    print(f"{len(items)} files, {sum(entry.damage is not None for entry in items)} of them spoilt")


if __name__ == "__main__":
    main()
