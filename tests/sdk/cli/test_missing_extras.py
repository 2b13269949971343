"""Without the packages of an extra every command that needs them says in one line how to get them.

Law: whatever part of `floatref` needs a package that is not installed, its exit code is 2, its one
line names the extra as a clone installs it, and no file is written.
"""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from floatref import Profile, ProfileTrack, write_profile

PARTS = {
    "plot": [
        ("matplotlib", ("process", "run", "--out", "p", "--plot", "p.png")),
        ("matplotlib", ("process", "run", "--out", "p", "--diagnostics")),
        ("matplotlib", ("compare", "road", "road", "--plot", "c.png")),
        ("matplotlib", ("allan", "run", "--plot", "a.png")),
        (
            "matplotlib",
            ("tune", "run", "--reference", "road", "--out", "t.json", "--plot", "t.png"),
        ),
        ("matplotlib", ("batch", "run", "--out", "out", "--plot", "b.png")),
    ],
    "batch": [
        (package, ("batch", "run", "--out", "out"))
        for package in ("cryptography", "dask", "distributed", "pyarrow")
    ],
    "adapters": [
        ("pyarrow", ("convert", "road", "--out", "road.parquet")),
        ("pyarrow", ("channels", "a.parquet")),
        ("nptdms", ("channels", "a.tdms")),
    ],
}
MAGIC = {
    "a.parquet": b"PAR1" + b"\0" * 40 + b"PAR1",
    "a.tdms": b"TDSm" + b"\0" * 60,
}
CASES = [(extra, *case) for extra, cases in PARTS.items() for case in cases]


def block(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every import of ``package``, and of what is in it, fail."""
    inside = [name for name in sys.modules if name.split(".")[0] == package]
    for name in {package, *inside}:
        monkeypatch.setitem(sys.modules, name, None)


@pytest.mark.parametrize(("extra", "package", "command"), CASES)
def test_a_missing_package_is_one_line_that_works_in_a_clone(
    extra: str,
    package: str,
    command: tuple[str, ...],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    refused: Callable[..., str],
) -> None:
    monkeypatch.chdir(tmp_path)
    elevation = 0.01 * np.sin(np.arange(800) * 0.25)
    write_profile(Profile(0.25, (ProfileTrack.of("left", elevation),)), Path("road"))
    Path("run").mkdir()
    for name, content in MAGIC.items():
        Path(name).write_bytes(content)
    before = sorted(tmp_path.rglob("*"))
    block(package, monkeypatch)
    line = refused(*command)
    assert f'run in a clone of floatref: pip install -e ".[{extra}]"' in line
    assert sorted(tmp_path.rglob("*")) == before
