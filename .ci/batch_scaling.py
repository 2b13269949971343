"""Write the tables on the costs of a batch from what was measured.

    python .ci/batch_scaling.py [--check]

`tests/benchmarks/bench_batch.py --json docs/data/batch.json` takes the measurements. A table stands
in a page between `<!-- batch: NAME -->` and `<!-- end -->`. `--check` compares instead.
"""

import argparse
import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
MEASURED = ROOT / "docs" / "data" / "batch.json"
PAGES = ("batch-scaling.md", "performance-growth.md")
PLACE = re.compile(r"(<!-- batch: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
NETWORK_KM = 10_000
CALCULATED = (10, 100)
LINKS = {"1 Gbit/s": 0.94e9 / 8, "10 Gbit/s": 9.4e9 / 8}
"""Bytes/s of payload that a link to a file server carries."""
BUSY = (
    "**Other work kept the machine busy: seconds of a processor, bytes and memory hold, but "
    "throughputs are disturbed, and two workers cannot be told from one.**"
)
Found = dict[str, Any]
Row = tuple[str, ...]


def table(head: Row, *rows: Row) -> str:
    """Return a table."""
    lines = [head, ("---",) * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def number(value: float, digits: int = 3) -> str:
    """Return ``value`` with so many digits, thousands set apart."""
    if abs(value) >= 10 ** (digits - 1):
        return f"{float(f'{value:.{digits}g}'):,.0f}"
    return f"{value:#.{digits}g}".rstrip(".")


def peak(found: Found) -> float:
    """Return the largest memory of a worker in bytes, of whatever it processed."""
    return max(part["peak_bytes"] for part in found.values() if "peak_bytes" in part)


def rates(found: Found) -> tuple[float, float]:
    """Return km and files that one worker does in a second, beside another worker."""
    two = found["scale"]["workers"][-1]
    km = two["steady_km_per_h"] / 3600 / two["workers"]
    return km, km / found["scale"]["km_per_file"]


def per_km(found: Found) -> str:
    """What a km costs, measured."""
    scale = found["scale"]
    (one, two) = scale["workers"]
    return table(
        ("measured", "value"),
        ("length of a recording", f"{number(scale['km_per_file'])} km"),
        ("read for a km", f"{number(scale['bytes_in_per_km'] / 1e6)} MB"),
        ("written for a km", f"{number(scale['bytes_out_per_km'] / 1e6)} MB"),
        ("seconds of a processor for a km", f"{number(scale['cpu_s_per_km'])} s"),
        ("resident memory of a worker, at most", f"{scale['peak_bytes'] / 1e6:.0f} MB"),
        ("one worker", _throughput(one)),
        ("two workers", _throughput(two)),
        ("two workers against one", f"{scale['ratio']:.2f}"),
        ("the same with the start-up", f"{scale['ratio_with_start']:.2f}"),
    )


def _throughput(row: Found) -> str:
    start, rate = number(row["start_s"], 2), number(row["steady_km_per_h"])
    return f"{rate} km/h after {start} s of start-up"


def pipelines(found: Found) -> str:
    """What a km costs in several pipelines."""
    return table(
        ("pipeline", "seconds of a processor", "written", "memory, at most"),
        *(
            (
                f"`{name}`",
                f"{number(cost['cpu_s_per_km'])} s",
                f"{number(cost['bytes_out_per_km'] / 1e6)} MB",
                f"{cost['largest_bytes'] / 1e6:.0f} MB",
            )
            for name, cost in found["pipelines"]["of"].items()
        ),
    )


def expected(found: Found) -> str:
    """What one, two, ten and a hundred workers do."""
    measured = [
        _line(found, row["workers"], row["steady_km_per_h"], "measured")
        for row in found["scale"]["workers"]
    ]
    each = rates(found)[0] * 3600
    return table(
        (
            "workers",
            "",
            "km/h",
            f"{NETWORK_KM:,} km take",
            "read",
            "written",
            "memory of all",
            "scheduler busy",
        ),
        *measured,
        *(_line(found, n, n * each, "calculated") for n in CALCULATED),
    )


def _line(found: Found, workers: int, km_per_h: float, how: str) -> Row:
    scale, per_s = found["scale"], km_per_h / 3600
    files = per_s / scale["km_per_file"]
    busy = 100 * files * found["overhead"]["scheduler_cpu_s_per_task"]
    return (
        str(workers),
        how,
        number(km_per_h),
        duration(NETWORK_KM / km_per_h),
        f"{number(per_s * scale['bytes_in_per_km'] / 1e6)} MB/s",
        f"{number(per_s * scale['bytes_out_per_km'] / 1e6)} MB/s",
        f"{number(workers * peak(found) / 1e9)} GB",
        f"{number(busy, 2)} %",
    )


def duration(hours: float) -> str:
    """Return a time as hours, or as minutes where that says more."""
    return f"{number(hours)} h" if hours >= 1 else f"{number(60 * hours)} min"


def limits(found: Found) -> str:
    """How many workers it takes to fill what they share."""
    km, files = rates(found)
    moved = km * (found["scale"]["bytes_in_per_km"] + found["scale"]["bytes_out_per_km"])
    task = found["overhead"]["scheduler_cpu_s_per_task"]
    short = 1 / found["corpus"]["cpu_s_per_file"]
    links = (
        (f"a file server behind {name}", f"{rate / moved:,.0f}") for name, rate in LINKS.items()
    )
    return table(
        ("what is full", "from so many workers"),
        *links,
        ("the scheduler, with these recordings", f"{1 / task / files:,.0f}"),
        ("the scheduler, with the short recordings below", f"{1 / task / short:,.0f}"),
    )


def behind(found: Found) -> str:
    """How long a network takes where the link to its file server may be full."""
    km = rates(found)[0]
    each = found["scale"]["bytes_in_per_km"] + found["scale"]["bytes_out_per_km"]
    rows = [
        (
            str(n),
            *(duration(NETWORK_KM / min(n * km, rate / each) / 3600) for rate in LINKS.values()),
        )
        for n in CALCULATED
    ]
    return table(("workers", *(f"behind {name}" for name in LINKS)), *rows)


def short(found: Found) -> str:
    """The thousand short recordings."""
    whole, killed, resumed = found["corpus"], found["worker"], found["resume"]
    cluster, task = found["cluster"], found["overhead"]
    length = f"{number(1000 * whole['km_per_file'])} m"
    return table(
        ("measured", "value"),
        ("recordings, of them corrupt", f"{whole['files']:,}, {whole['failed']}"),
        ("a recording, on average", f"{length}, {number(whole['bytes_in_per_file'] / 1e6)} MB"),
        ("by two workers", f"{number(whole['wall_s'])} s, exit code {whole['exit']}"),
        ("seconds of a processor for a file", f"{number(whole['cpu_s_per_file'])} s"),
        ("resident memory of a worker, at most", f"{whole['peak_bytes'] / 1e6:.0f} MB"),
        ("profiles with the bytes of `floatref process`", f"{whole['compared']} of as many drawn"),
        ("one worker killed: files in the summary", f"{killed['files']:,}, each once"),
        (
            "all killed, then `--resume`: finished files that were kept",
            f"{resumed['kept']} of {resumed['finished_before']}",
        ),
        ("by a scheduler and two workers on loopback", f"{number(cluster['wall_s'])} s"),
        ("a task that does nothing", f"{number(1e3 * task['wall_s_per_task'])} ms"),
        ("of it the scheduler", f"{number(1e3 * task['scheduler_cpu_s_per_task'])} ms"),
    )


def taken(found: Found) -> str:
    """When and where, and whether other work was in the way."""
    at = found["machine"]
    loads = [part["load"] for name, part in found.items() if name != "machine"]
    text = (
        f"Taken on {at['taken']} on {at['cores']} cores of an {at['processor']}, Python "
        f"{at['python']}, numpy {at['numpy']}, distributed {at['dask']}; load average of the "
        f"machine {min(loads):.1f} to {max(loads):.1f}, these runs among it.\n"
    )
    # A command and its two workers are three at most.
    return text if max(loads) <= at["cores"] + 1 else f"{text}{BUSY}\n"


def lines(found: Found) -> str:
    """The lines of the page on performance."""
    scale, whole = found["scale"], found["corpus"]
    return table(
        ("what", "measured", "aim"),
        ("two workers against one, start-up left out", f"{scale['ratio']:.2f}", "≥ 1.7"),
        ("the same with it", f"{scale['ratio_with_start']:.2f}", "–"),
        ("resident memory of a worker, at most", f"{peak(found) / 1e6:.0f} MB", "≤ 600 MB"),
        ("a km of two wheel paths at 16 kHz", f"{number(scale['cpu_s_per_km'])} s of CPU", "–"),
        (f"{whole['files']:,} short recordings", f"{number(whole['wall_s'])} s", "–"),
    )


PARTS: dict[str, Callable[[Found], str]] = {
    "taken": taken,
    "km": per_km,
    "pipelines": pipelines,
    "expected": expected,
    "limits": limits,
    "behind": behind,
    "short": short,
    "lines": lines,
}


def written(text: str, found: Found) -> str:
    """Return the page ``text`` with every table anew."""
    return PLACE.sub(lambda place: f"{place[1]}\n{PARTS[place[2]](found)}\n{place[3]}", text)


def main() -> int:
    """Write the pages, or return 1 if one is not what it would be."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    found = json.loads(MEASURED.read_text(encoding="utf-8"))
    for name in PAGES:
        page = ROOT / "docs" / name
        text = page.read_text(encoding="utf-8")
        if check and written(text, found) != text:
            print(f"{name}: run python .ci/batch_scaling.py", file=sys.stderr)
            return 1
        if not check:
            page.write_text(written(text, found), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
