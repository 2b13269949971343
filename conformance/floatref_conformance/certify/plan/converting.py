"""Profiles of any format, and recordings processed on the way, all as profiles in memory.

What is not our own directory or CSV goes through `floatref convert` and `floatref process`: the
judge itself reads no other format and has no pipeline.
"""

import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from floatref.errors import FloatrefError
from floatref.files import fingerprint_native, read_profile
from floatref.files.scratch import scratch_folder
from floatref.files.sources import open_bytes
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.plan.commands import Commands
from floatref_conformance.certify.plan.plan_document import Processing
from floatref_conformance.certify.plan.trails import Trail, read_trail

GUESSED = "guessed_units"
"""Key of the provenance under which `floatref convert` says which unit it guessed."""
PROCESSED = "processed by"
"""How the note on a recording begins."""
AT_ONCE = 2
"""Commands that run at the same time."""
LONGEST_HEADER = 1 << 16
"""Bytes in which the column of distance of our CSV has to turn up."""


@dataclass(frozen=True, eq=False)
class Converted:
    """What became of one source.

    Attributes:
        profile: None if it could not be read.
        notes: how it was made, and warnings.
        error: in one line, with the path, why there is no profile; empty otherwise.
        trail: where it was; None without positions.
    """

    profile: Profile | None
    notes: tuple[str, ...] = ()
    error: str = ""
    trail: Trail | None = None


def convert_all(
    paths: Sequence[Path], processing: Processing, report: Callable[[Path], None]
) -> Mapping[Path, Converted]:
    """Return the profile of every path of ``paths``, or why it has no profile.

    ``report`` is called with each path once it is read. Temporary files and commands are always
    gone at the end.
    """
    with (
        scratch_folder("conversion") as folder,
        ThreadPoolExecutor(AT_ONCE) as pool,
        Commands() as commands,
    ):
        work = {
            pool.submit(_convert, path, processing, folder / str(index), commands): path
            for index, path in enumerate(dict.fromkeys(paths))
        }
        for future in as_completed(work):
            report(work[future])
        return {path: future.result() for future, path in work.items()}


def _convert(path: Path, processing: Processing, out: Path, commands: Commands) -> Converted:
    try:
        if _is_ours(path):
            return Converted(_load_apart(read_profile(path), path))
        no_profile = ""
        if not path.is_dir():
            # A name without a suffix alone would be the directory of a recording as well.
            target = ("--guess-units", "--format", "profile", "--out", str(out))
            no_profile = commands.run("convert", *target, "--", str(path)).error
            if not no_profile:
                read = read_profile(out)
                guessed = read.provenance.get(GUESSED)
                return Converted(_load_apart(read, path), (str(guessed),) if guessed else ())
        return _process(path, processing, out, commands, no_profile)
    except (FloatrefError, OSError, MemoryError) as error:
        return Converted(None, error=_name_path(path, str(error) or type(error).__name__))


def _process(
    path: Path, processing: Processing, out: Path, commands: Commands, no_profile: str
) -> Converted:
    """Return what `floatref process` makes of ``path``, which for ``no_profile`` is no profile."""
    answer = commands.run(
        *("process", "--out", str(out), "--json"), *_options(processing), "--", str(path)
    )
    if answer.error:
        bare = [_without(path, reason) for reason in (no_profile, answer.error) if reason]
        if no_profile and bare[-1].startswith("is a profile, no recording"):
            # In the format of a profile: what is wrong with it is all there is to say.
            return Converted(None, error=f"{path}: {bare[0]}")
        both = f"no profile ({bare[0]}), and no recording ({bare[-1]})"
        return Converted(None, error=f"{path}: {both if len(bare) > 1 else bare[0]}")
    report = json.loads(answer.output)
    notes = (f"{PROCESSED} {report['pipeline']}", *report["warnings"])
    profile = _load_apart(read_profile(out), path)
    return Converted(profile, notes, trail=read_trail(path, profile))


def _options(processing: Processing) -> list[str]:
    """Return ``processing`` as options of `floatref process`."""
    given = {
        "--pipeline": processing.pipeline,
        "--settings": processing.settings,
        "--adapter": processing.adapter,
        "--map": processing.channel_map,
    }
    return [word for name, value in given.items() if value for word in (name, str(value))]


def _is_ours(path: Path) -> bool:
    """Return whether ``path`` is a profile directory or a CSV of ours, by its content."""
    if path.is_dir():
        return (path / "profile.json").is_file()
    with open_bytes(path) as stream:
        header = stream.readline(LONGEST_HEADER).removeprefix(b"\xef\xbb\xbf")
    return b"distance_m" in (name.strip(b' "\r\n') for name in header.split(b","))


def _load_apart(profile: Profile, source: Path) -> Profile:
    """Return ``profile`` apart from its files, which go away, with the SHA-256 of ``source``.

    A profile that names the inputs it was made from still names them.
    """
    tracks = [
        ProfileTrack.of(
            track.name,
            np.array(track.elevation),
            np.array(track.valid),
            None if track.sigma is None else np.array(track.sigma),
        )
        for track in profile.tracks
    ]
    provenance = profile.provenance
    if "sha256" not in provenance:
        hashes = fingerprint_native(source)
        provenance = {**provenance, "source": source.name, "sha256": hashes}
    return replace(profile, tracks=tuple(tracks), provenance=provenance)


def _name_path(path: Path, reason: str) -> str:
    """Return ``reason`` with the path at its start."""
    line = " ".join(reason.split())
    return line if line.startswith(str(path)) else f"{path}: {line}"


def _without(path: Path, reason: str) -> str:
    """Return ``reason`` without the path at its start."""
    return " ".join(reason.removeprefix(f"{path}: ").split())
