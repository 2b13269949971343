"""The content of batch.json: the options of a command, counts, and its effort."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from floatref.batch.jobs.natural_order import natural_key
from floatref.batch.results.totals import Tally
from floatref.files.atomic import replace_file
from floatref.files.document import plain, write_document
from floatref.files.schema import enforce
from floatref.version import __version__

FORMAT = "floatref-batch/1"
SCHEMA = "floatref-batch-1"
FILE = "batch.json"
USED = ("numpy", "numba", "scipy", "dask", "distributed", "pyarrow")
"""Distributions whose versions are recorded."""

PER_KM = ("cpu_s", "bytes_in", "bytes_out")
"""Sums that are also given per kilometre of profile."""


@dataclass(frozen=True)
class Command:
    """The command line: ``given`` are the inputs as typed, ``options`` the other ones by name."""

    given: Sequence[str]
    options: Mapping[str, Any]


@dataclass(frozen=True)
class Finished:
    """Duration of a command, its number of workers, and the files that it skipped."""

    wall_s: float
    workers: int
    passed_over: Sequence[Path] = ()
    no_longer_given: Sequence[str] = ()


def batch_document(command: Command, tally: Tally, finished: Finished) -> dict[str, Any]:
    """Return the content of batch.json in plain values.

    ``effort`` sums over all profiles in the summary, ``this_run`` is of this command alone.
    """
    document = {
        "format": FORMAT,
        "inputs": list(command.given),
        "options": dict(command.options),
        "versions": {"floatref": __version__, **{name: version(name) for name in USED}},
        "files": _files(tally, finished),
        "pipelines": _pipelines(tally),
        "length_km": tally.length_m / 1000.0,
        "warnings": tally.warnings,
        "effort": _effort(tally),
        "this_run": _this_run(tally, finished),
        "failures": [
            {"name": name, "error": tally.failed[name]}
            for name in sorted(tally.failed, key=natural_key)
        ],
    }
    return {**plain(document, "batch")}


def write_batch_document(document: Mapping[str, Any], out: Path) -> Path:
    """Write ``document`` as batch.json in ``out``, complete or not at all, and return where."""
    enforce(document, SCHEMA, out / FILE)
    with replace_file(out / FILE, overwrite=True) as beside:
        write_document(document, beside)
    return out / FILE


def _files(tally: Tally, finished: Finished) -> dict[str, int]:
    return {
        "found": tally.files,
        "done": tally.done,
        "failed": len(tally.failed),
        "skipped": tally.skipped,
        "passed_over": len(finished.passed_over),
        "no_longer_given": len(finished.no_longer_given),
    }


def _pipelines(tally: Tally) -> dict[str, int]:
    """Return the number of profiles by pipeline, the largest first; files end in any order."""
    return dict(sorted(tally.pipelines.items(), key=lambda item: (-item[1], item[0])))


def _effort(tally: Tally) -> dict[str, Any]:
    """Return the sums, and each per kilometre of profile, from which larger work is estimated."""
    sums = asdict(tally.effort)
    km = tally.length_m / 1000.0
    each = {f"{name}_per_km": sums[name] / km if km else None for name in PER_KM}
    return {**sums, **each}


def _this_run(tally: Tally, finished: Finished) -> dict[str, Any]:
    return {
        "processed": tally.processed,
        "wall_s": finished.wall_s,
        "workers": finished.workers,
        "length_km": tally.new_m / 1000.0,
    }
