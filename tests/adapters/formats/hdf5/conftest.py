"""Where a test writes its file, and all numbers of one."""

from pathlib import Path

import pytest

from floatref import NativeFile
from floatref_adapters.testing.whole_reading import whole


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run.h5"


def rows(native: NativeFile) -> dict[str, dict[str, list[float]]]:
    """Return the samples of every column of numbers, by the names of their streams."""
    return {s.name: {n: v.tolist() for n, v in whole(s)[0].items()} for s in native.streams}
