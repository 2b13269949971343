"""Simulated recordings kept on disk by their scenario's hash.

An entry's key also holds the version and the digest of the proving ground's own source, so
that a change of a model is never answered with an old recording. Entries are made beside
their place and renamed; one that lost or changed a byte is made again.
"""

import json
import os
import shutil
import tempfile
import zlib
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path

from floatref.files import read_profile, read_recording, write_profile, write_recording
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

FOLDER_VARIABLE = "FLOATREF_CACHE"
"""Environment variable that names another cache folder."""
LARGEST_BYTES = 8 * 1024**3
"""The least recently used entries go when the cache grows beyond this."""
RECORDING, TRUTH, CHECKSUMS = "recording", "truth", "checksums.json"


@dataclass(frozen=True)
class CachedSimulation:
    """Where a scenario's recording and truth lie; the truth is never under the recording.

    Attributes:
        recording_path: the recording directory.
        truth_path: the profile directory.
    """

    recording_path: Path
    truth_path: Path

    @property
    def recording(self) -> Recording:
        """The recording, its samples mapped read-only."""
        return read_recording(self.recording_path)

    @property
    def truth(self) -> Profile:
        """The unfiltered elevation along the laser's path."""
        return read_profile(self.truth_path)


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
    if _intact(entry):
        os.utime(entry)
    else:
        shutil.rmtree(entry, ignore_errors=True)
        _make(scenario, entry)
        _shrink(folder, entry, largest_bytes)
    return CachedSimulation(entry / RECORDING, entry / TRUTH)


def cache_folder() -> Path:
    """Return the folder of `FOLDER_VARIABLE`, else the user's cache folder."""
    named = os.environ.get(FOLDER_VARIABLE)
    if named:
        return Path(named)
    import platformdirs

    return Path(platformdirs.user_cache_dir("floatref"))


@cache
def source_digest() -> str:
    """Return the SHA-256 of the proving ground's modules and data."""
    digest = sha256()
    package = files(__package__)
    for resource in (package, package / "data"):
        for item in sorted(resource.iterdir(), key=lambda found: found.name):
            if item.is_file():
                digest.update(item.name.encode() + b"\0" + item.read_bytes())
    return digest.hexdigest()


def _key(scenario: Scenario) -> str:
    """Return the name of the scenario's entry."""
    parts = (scenario.hash, version("floatref"), source_digest())
    return sha256("\n".join(parts).encode()).hexdigest()[:32]


def _make(scenario: Scenario, entry: Path) -> None:
    """Simulate and write an entry beside its place, then rename it there."""
    simulation = simulate(scenario)
    entry.parent.mkdir(parents=True, exist_ok=True)
    beside = Path(tempfile.mkdtemp(prefix=".new-", dir=entry.parent))
    try:
        write_recording(simulation.recording, beside / RECORDING)
        write_profile(simulation.truth, beside / TRUTH)
        (beside / CHECKSUMS).write_text(json.dumps(_checksums(beside)), encoding="ascii")
        _rename(beside, entry)
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def _rename(beside: Path, entry: Path) -> None:
    """Give a new entry its name, unless another process was first with the same one."""
    try:
        os.rename(beside, entry)
    except OSError:
        if not _intact(entry):
            raise


def _checksums(entry: Path) -> dict[str, int]:
    """Return the CRC-32 of every file of an entry but the list itself."""
    sums = {}
    for path in sorted(entry.rglob("*")):
        if path.is_file() and path.name != CHECKSUMS:
            sums[path.relative_to(entry).as_posix()] = _crc(path)
    return sums


def _crc(path: Path) -> int:
    value = 0
    with path.open("rb") as stream:
        while piece := stream.read(1 << 20):
            value = zlib.crc32(piece, value)
    return value


def _intact(entry: Path) -> bool:
    """Return whether an entry exists and none of its files has changed."""
    try:
        listed = json.loads((entry / CHECKSUMS).read_text(encoding="ascii"))
        return bool(listed) and listed == _checksums(entry)
    except (OSError, ValueError):
        return False


def _shrink(folder: Path, kept: Path, largest_bytes: int) -> None:
    """Remove the least recently used entries, but never ``kept``, until the rest fits."""
    entries = [path.parent for path in folder.glob(f"*/{CHECKSUMS}")]
    sizes = {path: _size(path) for path in entries}
    for path in sorted(entries, key=lambda found: found.stat().st_mtime):
        if sum(sizes.values()) <= largest_bytes:
            return
        if path != kept:
            shutil.rmtree(path, ignore_errors=True)
            del sizes[path]


def _size(entry: Path) -> int:
    return sum(path.stat().st_size for path in entry.rglob("*") if path.is_file())
