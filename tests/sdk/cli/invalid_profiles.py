"""Profiles with random spans that are not valid, and the law that holds a command of them to marks.

In these spans the elevation is wrong by metres.
"""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
from click.testing import CliRunner
from hypothesis import strategies as st

from floatref import Profile, ProfileTrack, write_profile
from floatref.cli.main import main

Span = tuple[int, int]
"""First point and number of points that are not valid."""
COUNT = 320
SPANS = st.lists(st.tuples(st.integers(0, COUNT - 1), st.integers(1, 200)), max_size=2)
EXPLAINED = "* not all points are valid"
SHARES = "counted_share", "valid_share"


class Drawn(NamedTuple):
    """A folder with the profile `bad`, and `good` with the right road where `bad` is invalid."""

    folder: Path
    good: Profile
    bad: Profile

    @property
    def lost(self) -> bool:
        """Whether any point is not valid."""
        return not all(track.valid.all() for track in self.bad.tracks)


def profile(seed: int, spans: list[list[Span]], wrong: bool) -> Profile:
    rng = np.random.default_rng(seed)
    tracks = []
    for name, lost in zip(("left", "right"), spans, strict=True):
        valid, z = np.ones(COUNT, np.bool_), np.cumsum(rng.normal(0.0, 1e-3, COUNT))
        for first, size in lost:
            valid[first : first + size] = False
        bumps = 30.0 * rng.normal(size=COUNT)
        tracks.append(ProfileTrack.of(name, np.where(valid | (not wrong), z, bumps), valid))
    provenance = {"architecture": "temporal"}
    return Profile(0.25, tuple(tracks), pipeline="temporal-basic", provenance=provenance)


@contextmanager
def drawn(seed: int, left: list[Span], right: list[Span]) -> Iterator[Drawn]:
    with TemporaryDirectory() as name:
        made = Drawn(Path(name), *(profile(seed, [left, right], wrong) for wrong in (False, True)))
        write_profile(made.good, made.folder / "good")
        write_profile(made.bad, made.folder / "bad")
        yield made


def printed(*words: object) -> str:
    done = CliRunner().invoke(main, [str(word) for word in words])
    assert done.exit_code == 0, done.output
    return done.stdout


def pick(document: Any, *parts: str) -> list[Any]:
    """Return all values of a JSON document whose key has one of ``parts`` in it, in order."""
    if isinstance(document, list):
        return [value for each in document for value in pick(each, *parts)]
    if not isinstance(document, dict):
        return []
    own = [v for key, v in document.items() if any(part in key for part in parts)]
    return own + [value for each in document.values() for value in pick(each, *parts)]


def hold(drawn: Drawn, show: Callable[..., str]) -> None:
    """Hold the text and the JSON that ``show`` makes of a profile by its name to the law."""
    text, good, bad = show("bad"), show("good", "--json"), show("bad", "--json")
    for track in drawn.bad.tracks:
        first = next(line for line in text.splitlines() if line.startswith(f" {track.name}"))
        assert (first.split()[1] == "*") == (not track.valid.all()), first
    assert (EXPLAINED in text) == drawn.lost
    of_valid = [pick(json.loads(each), "of_valid", "counted_share") for each in (good, bad)]
    assert of_valid[0] == of_valid[1]
    shares = [share for share in pick(json.loads(bad), *SHARES) if share is not None]
    assert (min(shares) < 1.0) == drawn.lost
