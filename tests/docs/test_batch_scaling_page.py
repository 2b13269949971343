"""The page on the costs of a batch: its tables follow from what was measured."""

import importlib
import json
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "batch-scaling.md").read_text(encoding="utf-8")
MEASURED = json.loads((ROOT / "docs" / "data" / "batch.json").read_text(encoding="utf-8"))
SCALE, OVERHEAD = MEASURED["scale"], MEASURED["overhead"]
PEAK = max(part.get("peak_bytes", 0) for part in MEASURED.values())
WITHIN = 0.01
"""Three digits are shown."""


def numbers(cell: str) -> float:
    """Return the number that a cell begins with."""
    found = re.match(r"[\d,.]+", cell)
    assert found, cell
    return float(found[0].replace(",", ""))


def rows(heading: str) -> dict[str, list[str]]:
    """Return the first table below ``heading``, by the first cells."""
    table = PAGE.partition(f"## {heading}\n")[2].partition("\n## ")[0]
    lines = re.findall(r"^\| (.+) \|$", table, re.MULTILINE)[2:]
    return {cells[0]: cells[1:] for cells in (line.split(" | ") for line in lines)}


def rate_of_one() -> float:
    """Return what one of two workers does, in km/s: all recordings over the steady time."""
    two = SCALE["workers"][1]
    return SCALE["recordings"] * SCALE["km_per_file"] / two["steady_s"] / 2


def test_the_tables_are_written_from_the_measurements() -> None:
    found = subprocess.run(
        [sys.executable, ".ci/batch_scaling.py", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stderr


def test_all_parts_of_the_benchmark_were_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "benchmarks"))
    bench: ModuleType = importlib.import_module("bench_batch")
    assert MEASURED.keys() == {"machine", *bench.PARTS}


def test_the_ratio_is_that_of_the_times() -> None:
    one, two = SCALE["workers"]
    assert (one["workers"], two["workers"]) == (1, 2)
    steady = (one["wall_s"] - one["start_s"]) / (two["wall_s"] - two["start_s"])
    shown = rows("A kilometre")
    assert numbers(shown["two workers against one"][0]) == pytest.approx(steady, abs=0.006)
    whole = one["wall_s"] / two["wall_s"]
    assert numbers(shown["the same with the start-up"][0]) == pytest.approx(whole, abs=0.006)


@pytest.mark.parametrize("workers", [10, 100])
def test_what_is_expected_of_many_workers_follows_from_two(workers: int) -> None:
    how, km_per_h, hours, read, written, memory, busy = rows("1, 10 and 100 workers")[str(workers)]
    km_per_s = workers * rate_of_one()
    files_per_s = km_per_s / SCALE["km_per_file"]
    share = 100 * files_per_s * OVERHEAD["scheduler_cpu_s_per_task"]
    assert how == "calculated"
    assert numbers(km_per_h) == pytest.approx(3600 * km_per_s, rel=WITHIN)
    minutes = numbers(hours) * (60 if hours.endswith(" h") else 1)
    assert minutes == pytest.approx(10_000 / km_per_s / 60, rel=WITHIN)
    assert numbers(read) == pytest.approx(km_per_s * SCALE["bytes_in_per_km"] / 1e6, rel=WITHIN)
    assert numbers(written) == pytest.approx(km_per_s * SCALE["bytes_out_per_km"] / 1e6, rel=WITHIN)
    assert numbers(memory) == pytest.approx(workers * PEAK / 1e9, rel=WITHIN)
    assert numbers(busy) == pytest.approx(share, rel=0.06)


@pytest.mark.parametrize("link", [1, 10])
def test_a_link_is_full_where_it_carries_no_more(link: int) -> None:
    (shown,) = rows("What is full first")[f"a file server behind {link} Gbit/s"]
    each = rate_of_one() * (SCALE["bytes_in_per_km"] + SCALE["bytes_out_per_km"])
    assert numbers(shown) == pytest.approx(0.94 * link * 1e9 / 8 / each, abs=0.51, rel=0.01)


@pytest.mark.parametrize("workers", [10, 100])
def test_behind_a_link_the_network_takes_as_long_as_the_slower_of_both(workers: int) -> None:
    (table,) = re.findall(r"<!-- batch: behind -->\n(.+?)<!-- end -->", PAGE, re.DOTALL)
    (shown,) = re.findall(rf"^\| {workers} \| (.+) \| (.+) \|$", table, re.MULTILINE)
    moved = 10_000 * (SCALE["bytes_in_per_km"] + SCALE["bytes_out_per_km"])
    for link, cell in zip((1e9, 1e10), shown, strict=True):
        seconds = max(10_000 / (workers * rate_of_one()), moved / (0.94 * link / 8))
        found = numbers(cell) * (3600 if cell.endswith(" h") else 60)
        assert found == pytest.approx(seconds, rel=WITHIN)


def test_the_scheduler_is_full_where_tasks_come_faster_than_it_takes_them() -> None:
    shown = rows("What is full first")
    task = OVERHEAD["scheduler_cpu_s_per_task"]
    long = SCALE["km_per_file"] / rate_of_one() / task
    assert numbers(shown["the scheduler, with these recordings"][0]) == pytest.approx(
        long, rel=0.02
    )
    short = MEASURED["corpus"]["cpu_s_per_file"] / task
    found = numbers(shown["the scheduler, with the short recordings below"][0])
    assert found == pytest.approx(short, rel=0.02, abs=0.51)
