"""A small network in every format, some of it corrupt: rows, reasons, and the bytes of profiles."""

import importlib
import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[4]
CORRUPT = 10


@dataclass(frozen=True)
class Network:
    """The corpus, where the results are, and what the command said."""

    items: list[Any]
    corpus: Path
    out: Path
    code: int
    report: dict[str, Any]
    stderr: str


@pytest.fixture(scope="module")
def checks() -> Iterator[ModuleType]:
    """Return what holds of results; it finds the corpus beside it."""
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(ROOT / "tests" / "benchmarks"))
        yield importlib.import_module("batch_checks")


@pytest.fixture(scope="module")
def network(checks: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Network:
    """Four files of each format, of which ten are spoilt, each in a way of its own."""
    folder = tmp_path_factory.mktemp("network")
    writing = importlib.import_module("batch_corpus")
    count = 4 * len(writing.SUFFIXES)
    items = writing.write_corpus(folder / "corpus", count, CORRUPT, seed=5, seconds=4.0)
    manifest, out = folder / "corpus" / writing.MANIFEST, folder / "out"
    line = [sys.executable, "-m", "floatref", "batch", str(manifest), "--out", str(out)]
    done = subprocess.run(
        [*line, "--jobs", "2", "--segment", "20", "--json"], capture_output=True, text=True
    )
    report = json.loads(done.stdout)
    return Network(items, folder / "corpus", out, done.returncode, report, done.stderr)


def test_it_ends_with_the_code_for_some_that_failed(network: Network) -> None:
    assert network.code == 5, network.stderr
    assert "Traceback" not in network.stderr


def test_every_file_has_good_rows_or_one_that_says_why(
    network: Network, checks: ModuleType
) -> None:
    rows = checks.summary(network.out)
    assert checks.wrong_rows(network.items, rows) == []
    failed = [name for name, found in rows.items() if found[0]["status"] == "failed"]
    assert len(failed) == CORRUPT
    assert len(rows) == len(network.items)


def test_no_format_is_left_out(network: Network, checks: ModuleType) -> None:
    good = {item.path for item in network.items if item.damage is None}
    adapters = {
        found[0]["adapter"] for n, found in checks.summary(network.out).items() if n in good
    }
    assert adapters == {"recording", "mdf4", "tdms", "parquet", "arrow", "hdf5", "csv", "can"}


def test_profiles_are_those_of_the_files_one_by_one(
    network: Network, checks: ModuleType, tmp_path: Path
) -> None:
    chosen = {(i.suffix, i.pipeline): i for i in network.items if i.damage is None}
    found = checks.compared(list(chosen.values()), network.corpus, network.out, tmp_path / "alone")
    assert found.count == len(chosen) > 11
    assert found.differing == ()
