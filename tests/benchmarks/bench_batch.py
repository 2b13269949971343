"""A thousand recordings, ten of them corrupt, through `floatref batch`; what it costs.

    python tests/benchmarks/bench_batch.py [PART...] [--files 1000] [--json docs/data/batch.json]

    corpus     a thousand files in every format: exit code, rows, and the same bytes as one by one
    worker     some of them; SIGKILL of one worker in mid-run: every file in the summary once
    resume     SIGKILL of everything in mid-run, then --resume: no finished file is done again
    cluster    against a scheduler and two workers that were started on loopback
    scale      long recordings by one worker and by two, in turn: throughput, memory, seconds per km
    pipelines  what a km costs in three pipelines, by one worker
    overhead   what a task costs the scheduler

Without a part all of them. A line that fails begins with FAILS, and the exit code is 1.
"""

import argparse
import json
import os
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from batch_checks import compared, efforts, placed, summary, wrong_rows
from batch_corpus import MANIFEST, Item, write_corpus, write_manifest
from batch_runs import Run, batch, cluster, end_all, end_worker, records_in
from batch_scale import by_pipeline, machine, overhead, scale

LIMIT_MB = 600
LEAST_RATIO = 1.7


@dataclass
class Bench:
    work: Path
    items: list[Item]
    some: list[Item]
    identical: int
    drives: int
    jobs: int = 2
    failed: bool = False
    found: dict[str, Any] = field(default_factory=dict)

    @property
    def manifest(self) -> Path:
        return self.work / "corpus" / MANIFEST

    @property
    def shorter(self) -> Path:
        """What is given where workers die."""
        return self.work / "corpus" / "some.csv"

    def held(self, right: bool, text: str) -> None:
        """Print a line, and remember if it fails."""
        print(f"{'ok   ' if right else 'FAILS'}  {text}", flush=True)
        self.failed |= not right

    def common(self, part: str, run: Run, out: Path, items: Sequence[Item]) -> dict[str, Any]:
        """Print and return what every run of ``items`` is held to."""
        bad = sum(item.damage is not None for item in items)
        right = run.code == (5 if bad else 0)
        self.held(right, f"{part}: exit {run.code}{'' if right else ' ' + run.stderr[-2000:]}")
        rows = summary(out) if right else {}
        wrong = wrong_rows(items, rows)
        self.held(not wrong, f"{part}: {len(rows)} files in the summary once, {bad} say why not")
        for line in wrong[:10]:
            print(f"         {line}")
        lines = sum(map(len, rows.values()))
        peak = max(run.peaks.values(), default=0)
        self.held(0 < peak <= LIMIT_MB * 1e6, f"{part}: {peak / 1e6:.0f} MB in a worker at most")
        print(f"       {part}: {run.seconds:.1f} s, {lines} rows", flush=True)
        return {
            "files": len(rows),
            "failed": sum(r[0]["status"] == "failed" for r in rows.values()),
            "rows": lines,
            "exit": run.code,
            "wall_s": run.seconds,
            "peak_bytes": peak,
        }


def corpus(bench: Bench) -> dict[str, Any]:
    """Every format, some corrupt; a sample is processed one by one, too."""
    out = bench.work / "whole"
    run = batch([bench.manifest, "--out", out, "--jobs", str(bench.jobs)])
    found = bench.common("corpus", run, out, bench.items)
    costs = efforts(out)
    draw = np.random.default_rng(0)
    chosen = [bench.items[k] for k in draw.permutation(len(bench.items))[: bench.identical]]
    same = compared(chosen, bench.manifest.parent, out, bench.work / "alone")
    text = f"corpus: {same.count} drawn files have the bytes of `floatref process`"
    bench.held(not same.differing, ", ".join([text, *same.differing[:5]]))
    return {
        **found,
        "jobs": bench.jobs,
        "with_place": placed(summary(out)),
        "compared": same.count,
        "cpu_s_per_file": sum(cost["cpu_s"] for cost in costs) / len(costs),
        "bytes_in_per_file": sum(cost["bytes_in"] for cost in costs) / len(costs),
        "bytes_out_per_file": sum(cost["bytes_out"] for cost in costs) / len(costs),
        "km_per_file": sum(cost["length_m"] for cost in costs) / len(costs) / 1000,
    }


def worker(bench: Bench) -> dict[str, Any]:
    """A worker dies; what it was at is done by another."""
    out = bench.work / "worker"
    watch = end_worker(out, len(bench.some) // 4)
    run = batch([bench.shorter, "--out", out, "--jobs", str(bench.jobs)], watch)
    found = bench.common("worker", run, out, bench.some)
    bench.held(len(run.peaks) > bench.jobs, f"worker: {len(run.peaks)} processes for 2 workers")
    return found


def resume(bench: Bench) -> dict[str, Any]:
    """Everything dies; what was done stays as it is."""
    out = bench.work / "resume"
    arguments = [bench.shorter, "--out", out, "--jobs", str(bench.jobs)]
    killed = batch(arguments, end_all(out, len(bench.some) // 2))
    bench.held(killed.code == -9, f"resume: first run ended by signal {-killed.code}")
    done = _finished(out)
    again = batch([*arguments, "--resume"])
    found = bench.common("resume", again, out, bench.some)
    kept = sum(_profile_stamp(out, name) == stamp for name, stamp in done.items())
    bench.held(kept == len(done) > 0, f"resume: {kept} of {len(done)} finished files were kept")
    return {**found, "finished_before": len(done), "kept": kept}


def _finished(out: Path) -> dict[str, tuple[int, int]]:
    """Return what tells a profile from one written anew, by the name of every finished file."""
    found = {}
    for path in records_in(out):
        if not json.loads(path.read_text(encoding="utf-8"))["error"]:
            name = path.relative_to(out / "records").as_posix().removesuffix(".json")
            found[name] = _profile_stamp(out, name)
    return found


def _profile_stamp(out: Path, name: str) -> tuple[int, int]:
    state = (out / "profiles" / name / "profile.json").stat()
    return state.st_ino, state.st_mtime_ns


def existing(bench: Bench) -> dict[str, Any]:
    """A scheduler and two workers that are there already do the same."""
    out = bench.work / "cluster"
    with cluster(2, bench.work) as (address, workers, _):
        run = batch([bench.shorter, "--out", out, "--cluster", address], helpers=workers)
    return bench.common("cluster", run, out, bench.some)


def scaled(bench: Bench) -> dict[str, Any]:
    """Long recordings: one and two workers in turn."""
    folder = bench.work / "scale"
    found = scale(folder, bench.drives)
    one, two = found["workers"]
    ratio = two["steady_km_per_h"] / one["steady_km_per_h"]
    whole = two["km_per_h"] / one["km_per_h"]
    text = f"scale: two workers do {ratio:.2f} times what one does, {whole:.2f} with the start-up"
    bench.held(ratio >= LEAST_RATIO, f"{text}; aim {LEAST_RATIO}")
    peak = found["peak_bytes"]
    bench.held(peak <= LIMIT_MB * 1e6, f"scale: {peak / 1e6:.0f} MB in a worker at most")
    print(f"       scale: {found['cpu_s_per_km']:.2f} s of the processor for a km")
    return {**found, "ratio": ratio, "ratio_with_start": whole}


def pipelines(bench: Bench) -> dict[str, Any]:
    """Long recordings in several pipelines."""
    found = by_pipeline(bench.work)
    for name, cost in found["of"].items():
        memory = cost["largest_bytes"] / 1e6
        text = f"{cost['cpu_s_per_km']:.2f} s of the processor for a km, {memory:.0f} MB at most"
        bench.held(memory <= LIMIT_MB, f"pipelines: {name}: {text}")
    return found


def empty_tasks(bench: Bench) -> dict[str, Any]:
    """Tasks that do nothing."""
    found = overhead(bench.work)
    each, cpu = found["wall_s_per_task"], found["scheduler_cpu_s_per_task"]
    print(f"       overhead: {1e3 * each:.2f} ms for a task, {1e3 * cpu:.2f} of the scheduler's")
    return found


PARTS: dict[str, Callable[[Bench], dict[str, Any]]] = {
    "corpus": corpus,
    "worker": worker,
    "resume": resume,
    "cluster": existing,
    "scale": scaled,
    "pipelines": pipelines,
    "overhead": empty_tasks,
}


def kept(file: Path, found: dict[str, Any]) -> None:
    """Put what was found into ``file``; parts that were not run stay."""
    before = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps({**before, **found}, indent=1) + "\n", encoding="utf-8")


def options(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Return what the command line says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(PARTS))
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--corrupt", type=int, default=10)
    parser.add_argument("--some", type=int, default=300, help="files where workers die")
    parser.add_argument("--identical", type=int, default=100, help="files processed one by one")
    parser.add_argument("--drives", type=int, default=16, help="long recordings")
    parser.add_argument("--json", type=Path, help="where the figures go")
    given = parser.parse_args(arguments)
    unknown = set(given.parts) - set(PARTS)
    if unknown:
        parser.error(f"no part {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    return given


def main() -> int:
    """Run the parts; return 1 if something does not hold."""
    given = options()
    parts = given.parts or list(PARTS)
    found: dict[str, Any] = {"machine": machine()}
    with tempfile.TemporaryDirectory(prefix="floatref-bench-") as name:
        bench = Bench(Path(name), [], [], given.identical, given.drives)
        if set(parts) - {"scale", "pipelines", "overhead"}:
            folder, jobs = bench.manifest.parent, os.cpu_count() or 1
            bench.items = write_corpus(folder, given.files, given.corrupt, jobs=jobs)
            bench.some = bench.items[: given.some]
            write_manifest(bench.shorter, bench.some)
        for part in parts:
            found[part] = {**PARTS[part](bench), "load": round(os.getloadavg()[0], 2)}
    if given.json is not None:
        kept(given.json, found)
    return int(bench.failed)


if __name__ == "__main__":
    sys.exit(main())
