"""A tree with a recording and a profile in every format, and a search of it."""

import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from floatref.batch.jobs.inputs import Defaults, Found, find_jobs
from floatref.engine.formats import write_as
from floatref.engine.plugins import plugins
from floatref.files import write_profile, write_recording
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref_adapters.testing import WRITERS


def recording() -> Recording:
    clock = UniformClock.of(100.0)
    samples = {"distance": 0.1, "height": 1.0, "vertical_specific_force": 9.8}
    channels = (Channel.of(n, x * np.arange(1.0, 51.0), clock) for n, x in samples.items())
    return Recording(tuple(channels))


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a tree with a recording in every format, profiles in every format, and the rest."""
    tree = tmp_path_factory.mktemp("made") / "tree"
    for suffix, write in WRITERS.items():
        folder = tree / suffix[1:]
        folder.mkdir(parents=True)
        write(recording(), folder / f"run{suffix}", None)
    (tree / "ours").mkdir()
    write_recording(recording(), tree / "ours" / "run")
    profile = Profile(0.05, (ProfileTrack.of("main", np.zeros(100)),))
    done = tree / "profiles"
    done.mkdir()
    write_profile(profile, done / "p")
    for form in plugins().profile_formats().values():
        if form.suffix:
            write_as(form, profile, done / f"p{form.suffix}")
    (tree / "notes.md").write_text("a, b\n")
    (tree / "run.txt").write_text("time\theight\n0.0\t1.0\n0.1\t1.1\n")
    (tree / "readme.txt").write_text("What this is\n")
    (tree / "list.csv").write_text("file\ncsv/run.csv\n")
    (tree / ".hidden.csv").write_text("time,height\n0,1\n")
    (tree / ".floatref-12").mkdir()
    (tree / ".floatref-12" / "run.csv").touch()
    (tree / "damaged.mf4").write_bytes(b"\0" * 100)
    return tree


@pytest.fixture
def tree(made: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(made, tmp_path / "tree"))


@pytest.fixture
def find(tmp_path: Path) -> Callable[..., Found]:
    def call(*given: object, **options: object) -> Found:
        return find_jobs([str(each) for each in given], tmp_path / "out", Defaults(**options))

    return call
