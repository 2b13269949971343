"""Simulated recordings kept on disk by their scenario's hash.

An entry's key also holds the version and the digest of the source that shapes a recording, so
that a change of a model is never answered with an old recording. Several processes can share
a cache; an entry that lost or changed a byte is made again.
"""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import TypeVar

from floatref.errors import InputError
from floatref.files import read_profile, read_recording, write_profile, write_recording
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.proving_ground import entries
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.room import bytes_of, needing_room

FOLDER_VARIABLE = "FLOATREF_CACHE"
"""Environment variable that names another cache folder."""
LARGEST_BYTES = 8 * 1024**3
"""The least recently used entries go when the cache grows beyond this."""
ATTEMPTS = 5
"""How often an entry that other processes evict or damage is made again while it is read."""
SHAPING = ("floatref.values", "floatref.measures", "floatref.kernels", "floatref.files")
"""Packages beside this one whose source decides what a recording holds."""
RECORDING, TRUTH = "recording", "truth"
_Read = TypeVar("_Read")


@dataclass(frozen=True)
class CachedSimulation:
    """Where a scenario's recording and truth lie; the truth is never under the recording.

    Attributes:
        recording_path: the recording directory.
        truth_path: the profile directory.
        scenario: what was simulated.
    """

    recording_path: Path
    truth_path: Path
    scenario: Scenario

    @property
    def recording(self) -> Recording:
        """The recording, its samples mapped read-only."""
        return self._surely(read_recording, self.recording_path)

    @property
    def truth(self) -> Profile:
        """The unfiltered elevation along the laser's path."""
        return self._surely(read_profile, self.truth_path)

    def _surely(self, read: Callable[[Path], _Read], path: Path) -> _Read:
        """Return what ``read`` makes of ``path``, remaking an entry that is gone by now."""
        for _ in range(ATTEMPTS):
            try:
                return read(path)
            except InputError:
                _ensure(self.scenario, path.parent)
        return read(path)


def simulate_cached(
    scenario: Scenario, folder: Path | None = None, largest_bytes: int = LARGEST_BYTES
) -> CachedSimulation:
    """Return the scenario's recording and truth from the cache, simulated if need be.

    Args:
        scenario: what to simulate.
        folder: the cache; `cache_folder` if not given.
        largest_bytes: size of the cache beyond which the least recently used entries go.
    """
    folder = cache_folder() if folder is None else folder
    entry = folder / _key(scenario)
    if _ensure(scenario, entry):
        entries.prune(folder)
        entries.shrink(folder, entry, largest_bytes)
    return CachedSimulation(entry / RECORDING, entry / TRUTH, scenario)


def cache_folder() -> Path:
    """Return the folder of `FOLDER_VARIABLE`, else the user's cache folder."""
    named = os.environ.get(FOLDER_VARIABLE)
    if named:
        return Path(named)
    import platformdirs

    return Path(platformdirs.user_cache_dir("floatref"))


@cache
def source_digest() -> str:
    """Return the SHA-256 of the proving ground's modules and data and of `SHAPING`."""
    digest = sha256()
    for package in (__package__, *SHAPING):
        for name, content in _sources(files(package), package):
            digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def _sources(folder: Traversable, name: str) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every file below ``folder`` but the compilers' caches."""
    for item in sorted(folder.iterdir(), key=lambda found: found.name):
        path = f"{name}/{item.name}"
        if item.is_file():
            yield path, item.read_bytes()
        elif item.name != "__pycache__":
            yield from _sources(item, path)


def _key(scenario: Scenario) -> str:
    """Return the name of the scenario's entry."""
    parts = (scenario.hash, version("floatref"), source_digest())
    return sha256("\n".join(parts).encode()).hexdigest()[: entries.KEY_LENGTH]


def _ensure(scenario: Scenario, entry: Path) -> bool:
    """Mark the scenario's entry as used, or make it; return whether it was made."""
    if entries.use(entry):
        return False
    simulation = simulate(scenario)
    needed = bytes_of(simulation.recording)
    with needing_room(entry.parent, needed, FOLDER_VARIABLE), entries.new_entry(entry) as beside:
        write_recording(simulation.recording, beside / RECORDING)
        write_profile(simulation.truth, beside / TRUTH)
    return True
