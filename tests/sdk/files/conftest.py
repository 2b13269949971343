"""A plausible recording and its directory, to be spoilt."""

import json
import os
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from floatref.files import write_recording
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording, Setup, TrackSetup


@pytest.fixture
def recording() -> Recording:
    clock = UniformClock.of(1000.0, 5.0)
    slow = UniformClock.of(100.0, 5.0)
    force = 9.8 + 0.1 * np.sin(np.arange(3000.0))
    return Recording(
        (
            Channel.of("vertical_specific_force", force, clock, "left"),
            Channel.of("height", 0.3 + 0.01 * np.cos(np.arange(3000.0)), clock, "left"),
            Channel.of("distance", 0.2 * np.arange(300.0), slow),
            Channel.of("gnss_height", [100.0, np.nan, 101.0], StampedClock.of([5.0, 6.1, 7.0])),
        ),
        Setup(tracks={"left": TrackSetup((1.0, 2.0, 0.5), (0.0, 0.1, 0.2))}),
    )


@pytest.fixture
def folder(recording: Recording, tmp_path: Path) -> Path:
    directory = tmp_path / "run"
    write_recording(recording, directory)
    return directory


@pytest.fixture
def edit() -> Callable[[Path, Callable[[Any], Any]], None]:
    """Change the JSON document at a path by a function that works in place."""

    def change(path: Path, function: Callable[[Any], Any]) -> None:
        document = json.loads(path.read_text())
        function(document)
        path.write_text(json.dumps(document))

    return change


@pytest.fixture
def unprivileged(tmp_path: Path) -> Callable[[], AbstractContextManager[None]]:
    """Take away the rights of the administrator, who may read and write everything."""

    @contextmanager
    def lowered() -> Iterator[None]:
        user = os.geteuid()
        # pytest's folders are closed to others, so this one stands for the user's own.
        for parent in (tmp_path, *tmp_path.parents[:3]):
            if parent.stat().st_uid == user and user == 0:
                parent.chmod(0o755)
        if user == 0:
            os.seteuid(65534)
        try:
            yield
        finally:
            os.seteuid(user)

    return lowered
