"""The profiles of a case in an archive, and a device that gives them out."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.files import fingerprint, read_bytes, read_profile, write_profile
from floatref.files.scratch import scratch_folder
from floatref.values.profile import Profile
from floatref_conformance.checks.verdict import Pass
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.exercise import hold_in_memory

FOLDER = "answers"
MOST_BYTES = 1 << 28
MEMBER = re.compile(r"(answer|truth)-([1-9][0-9]{0,3})/(profile\.json|[A-Za-z0-9_.-]+\.(f64|u8))")


def write_passes(passes: Sequence[Pass]) -> dict[str, bytes]:
    """Return the profiles of ``passes`` as files by name: ``answer-1/profile.json`` and so on.

    Of each pass there are the true profile and, of the delivered one, the wheel paths of the truth.
    """
    with scratch_folder("answers") as folder:
        for number, done in enumerate(passes, 1):
            names = {track.name for track in done.truth.tracks}
            asked = tuple(track for track in done.result.tracks if track.name in names)
            result = Profile(done.result.interval_m, asked, done.result.start_m)
            truth = Profile(done.truth.interval_m, done.truth.tracks, done.truth.start_m)
            write_profile(result, folder / f"answer-{number}")
            write_profile(truth, folder / f"truth-{number}")
        files = (path for path in sorted(folder.rglob("*")) if path.is_file())
        return {
            path.relative_to(folder).as_posix(): read_bytes(path, MOST_BYTES, "profile")
            for path in files
        }


def read_passes(files: Mapping[str, bytes], kind: str) -> tuple[Profile, ...]:
    """Return the profiles of ``kind``, `answer` or `truth`, among ``files``, in their order.

    Raises InputError for files that make no profile.
    """
    numbers = sorted({number for name in files for stem, number in [_place(name)] if stem == kind})
    with scratch_folder("answers") as folder:
        for name, content in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
        paths = [folder / f"{kind}-{number}" for number in numbers]
        return tuple(_hold(read_profile(path), path) for path in paths)


def _place(name: str) -> tuple[str, int]:
    """Return kind and number of the profile that a file belongs to; InputError for others."""
    found = MEMBER.fullmatch(name)
    if found is None:
        raise InputError(f"{name}: is no part of a submission; ask for the archive again")
    return found[1], int(found[2])


def _hold(profile: Profile, path: Path) -> Profile:
    """Return ``profile`` in memory, so that its files can go.

    InputError for one that needs more than its files in ``path``: several wheel paths in one file.
    """
    taken = sum(track.elevation.nbytes for track in profile.tracks)
    if taken > sum(file.stat().st_size for file in path.iterdir()):
        raise InputError(f"{path.name}: wheel paths share a file; ask for the archive again")
    return hold_in_memory(profile)


@dataclass(eq=False)
class StoredAnswers:
    """A device that delivers ``profiles`` in their order, and hashes what it is given.

    Attributes:
        inputs: of each recording that it got, the SHA-256 of every file.
    """

    profiles: Sequence[Profile]
    description: Mapping[str, Any]
    inputs: list[dict[str, str]] = field(default_factory=list)

    def describe(self) -> Mapping[str, Any]:
        """Return the description in the archive."""
        return self.description

    def run(self, recording: Path, profile: Path) -> None:
        """Write the next profile; DeviceError if there is no more."""
        self.inputs.append(fingerprint(recording))
        if len(self.inputs) > len(self.profiles):
            raise DeviceError("the archive has no profile of this recording")
        write_profile(self.profiles[len(self.inputs) - 1], profile)


def largest_difference(one: Profile, other: Profile) -> float:
    """Return the largest distance in m between two true profiles; infinite if their axes differ.

    Raises InputError if a wheel path is missing in ``other``.
    """
    if (one.interval_m, one.start_m) != (other.interval_m, other.start_m):
        return np.inf
    largest = 0.0
    for track in one.tracks:
        z = other.track(track.name).elevation
        if z.size != track.elevation.size or (np.isnan(z) != np.isnan(track.elevation)).any():
            return np.inf
        largest = max(largest, float(np.nanmax(np.abs(z - track.elevation), initial=0.0)))
    return largest


def refuse_without(files: Mapping[str, bytes], name: str) -> bytes:
    """Return file ``name`` of ``files``; InputError if it is missing."""
    if name not in files:
        raise InputError(f"{name}: missing in the archive; ask for it again")
    return files[name]
