"""`floatref batch --cluster`: a scheduler and workers that were started separately."""

import socket
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.posix]

FILES = {"a": ("ready", 300), "b": ("ready", 200), "c": ("ready", 100), "bad": ("odd", 50)}
IMPATIENT = (
    "import floatref.batch.work.cluster as cluster; cluster.WORKERS_S = cluster.ANSWER_S = 0.5\n"
    "from floatref.cli.main import main; main()"
)


def start(bench: Any, kind: str, *arguments: str) -> Any:
    """Start a scheduler or a worker of Dask on this machine alone."""
    program = (sys.executable, "-m", f"distributed.cli.dask_{kind}")
    places = ("--scheduler-file", str(bench.folder / "scheduler.json"))
    return bench.start(*places, "--no-dashboard", *arguments, program=program)


def start_worker(bench: Any) -> Any:
    return start(bench, "worker", "--nthreads", "1", "--no-nanny", "--host", "127.0.0.1")


@pytest.fixture
def address(bench: Any) -> str:
    """Return where a scheduler without workers listens."""
    start(bench, "scheduler", "--host", "127.0.0.1", "--port", "0")
    file: Path = bench.folder / "scheduler.json"
    bench.wait_until(lambda: file.exists() and '"address"' in file.read_text(encoding="utf-8"))
    return str(bench.scheduler_address())


@pytest.fixture
def unused() -> Iterator[str]:
    """Yield an address at which nobody listens."""
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        yield f"tcp://127.0.0.1:{held.getsockname()[1]}"


def test_the_summary_is_that_of_the_local_cluster(bench: Any, address: str) -> None:
    bench.put(**FILES)
    for _ in range(2):
        start_worker(bench)
    report = bench.report_of(bench.batch("--cluster", address), code=5)
    assert report["files"]["done"] == 3
    assert [failure["name"] for failure in report["failures"]] == ["bad.gate"]
    here = bench.start("batch", "in", "--out", "here", "--json", "--jobs", "1")
    assert bench.report_of(here, code=5)["files"] == report["files"]
    for name in ("summary.csv", "summary.parquet"):
        assert (bench.out / name).read_bytes() == (bench.folder / "here" / name).read_bytes()
    assert list(bench.out.rglob(".floatref-*")) == []
    assert not (bench.out / ".cluster").exists()


def test_a_scheduler_that_dies_leaves_rows_that_say_so(bench: Any, address: str) -> None:
    bench.put(a=("ready", 300), w0=("wait", 200))
    start_worker(bench)
    process = bench.batch("--cluster", address)
    bench.wait_until(lambda: len(bench.records()) == 1 and bench.at_work() == 1)
    bench.started[0].kill()
    report = bench.report_of(process, code=5)
    # Whether the scheduler had passed on that the other was done is its secret.
    assert report["files"]["done"] + report["files"]["failed"] == 2
    errors = {failure["name"]: failure["error"] for failure in report["failures"]}
    assert "the cluster was lost before this file was done" in errors["w0.gate"]


@pytest.mark.parametrize(("there", "text"), [(True, "has no workers"), (False, "no scheduler")])
def test_a_cluster_that_cannot_work_is_one_line(
    bench: Any, unused: str, request: pytest.FixtureRequest, there: bool, text: str
) -> None:
    bench.put(**FILES)
    place = request.getfixturevalue("address") if there else unused
    program = (sys.executable, "-c", IMPATIENT)
    arguments = ("batch", "in", "--out", "out", "--cluster", place)
    code, out, err = bench.ended(bench.start(*arguments, program=program))
    assert (code, out) == (2, "")
    assert err.startswith(f"Error: cluster {place}: ")
    assert text in err
    assert err.count("\n") == 0
    assert not bench.out.exists()
