"""What has to hold of the results of `floatref batch`; each check returns what is wrong."""

import csv
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from batch_corpus import Item
from click.testing import CliRunner

from floatref.cli.main import main

Table = dict[str, list[dict[str, str]]]


def summary(out: Path) -> Table:
    """Return the rows of the summary by the name of their file."""
    rows: Table = {}
    with (out / "summary.csv").open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream):
            rows.setdefault(row["name"], []).append(row)
    return rows


def wrong_rows(items: Sequence[Item], rows: Table) -> list[str]:
    """Return what is wrong with a summary: every file once, good or with the reason."""
    wrong = [f"{name}: not among the inputs" for name in rows.keys() - {i.path for i in items}]
    for item in items:
        wrong += _wrong(item, rows.get(item.path, []))
    return wrong


def _wrong(item: Item, rows: list[dict[str, str]]) -> list[str]:
    if not rows:
        return [f"{item.path}: not in the summary"]
    places = [(row["track"], row["segment"]) for row in rows]
    if len(set(places)) != len(places):
        return [f"{item.path}: more than once in the summary"]
    if item.damage is not None:
        return _wrong_failure(item.path, item.damage.says, rows)
    bad = [row for row in rows if row["status"] != "done" or row["error"] or not _good(row)]
    return [f"{item.path}: {row['error'] or row}" for row in bad]


def _wrong_failure(name: str, says: str, rows: list[dict[str, str]]) -> list[str]:
    (row, *more) = rows
    if more or row["status"] != "failed" or "\n" in row["error"] or says not in row["error"]:
        return [f"{name}: {row['status']}, {row['error']!r}; expected one row with {says!r}"]
    return []


def _good(row: Mapping[str, str]) -> bool:
    return math.isfinite(float(row["iri_m_per_km"] or "nan")) and float(row["length_m"]) > 0


def placed(rows: Table) -> int:
    """Return how many files have a place in every row."""
    return sum(
        all(math.isfinite(float(row["latitude_deg"] or "nan")) for row in found)
        for found in rows.values()
    )


@dataclass(frozen=True)
class Compared:
    """How many profiles were compared with those of `floatref process`, and which differ."""

    count: int
    differing: tuple[str, ...]


def compared(items: Sequence[Item], corpus: Path, out: Path, work: Path) -> Compared:
    """Process ``items`` one by one; compare every file of every profile byte by byte."""
    work.mkdir(parents=True, exist_ok=True)
    good = [item for item in items if item.damage is None]
    differing = [i.path for i in good if not _is_same(i, corpus, out, work / f"{i.number}")]
    return Compared(len(good), tuple(differing))


def _is_same(item: Item, corpus: Path, out: Path, alone: Path) -> bool:
    arguments = ["process", str(corpus / item.path), "--out", str(alone), "--json"]
    for option, value in (("--map", item.chart), ("--settings", item.settings)):
        arguments += [option, str(corpus / value)] if value else []
    arguments += ["--pipeline", item.pipeline] if item.pipeline else []
    done = CliRunner().invoke(main, arguments)
    if done.exit_code:
        raise RuntimeError(f"{item.path}: {done.output}")
    return _bytes(alone) == _bytes(out / "profiles" / item.path)


def _bytes(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def efforts(out: Path) -> list[dict[str, float]]:
    """Return what every file that was processed has cost, with its length in m."""
    found = []
    for path in (out / "records").rglob("*.json"):
        record = json.loads(path.read_text(encoding="utf-8"))
        if not record["error"]:
            found.append({**record["effort"], "length_m": record["length_m"]})
    return found
