"""Write the outputs of six whole recordings as numbers, or print how they differ from those stored.

    python .ci/outputs.py [--write] [--recording NAME]... [--pipeline NAME]...

The recordings are simulated from fixed scenarios; every pipeline that can take one runs on it, with
its default settings. Without --write the exit code is 1 if a number differs by more than its
tolerance. docs/change-indication.md says what a difference means.
"""

import argparse
import sys
import warnings
from collections.abc import Collection, Iterator, Mapping
from math import isfinite, isnan, nan
from pathlib import Path

from whole_recordings import INTERVAL_M, NAMES, RECORDINGS, UNITS, Row, measure, record

import floatref
from floatref.files.atomic import replace_file

FILE = Path(__file__).parents[1] / "docs" / "data" / "outputs.txt"
COMMAND = "python .ci/outputs.py --write"
FLOORS = {"m/km": 0.002, "mm": 0.02, "m": 2.5 * INTERVAL_M}
"""Smaller differences are ignored, by unit; two points more or less of a flagged length, too."""
SHARE = 2e-3
"""Smaller differences, as a share of the stored value, are ignored: it has four digits."""
REFUSED = "refused"
Key = tuple[str, str]


def make_rows(recordings: Collection[str], pipelines: Collection[str]) -> Iterator[tuple[Key, Row]]:
    """Yield the numbers of each recording and pipeline that can take it; () if it is refused."""
    for name in recordings:
        recording = record(name)
        for pipeline in (p for p in pipelines if RECORDINGS[name].takes(p)):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", floatref.FloatrefWarning)
                try:
                    profile = floatref.process(recording, pipeline)
                except floatref.InputError:
                    yield (name, pipeline), ()
                    continue
            yield (name, pipeline), measure(profile, RECORDINGS[name].at_m)


def write_text(rows: Mapping[Key, Row]) -> str:
    """Return ``rows`` as text, one line for each, columns aligned."""
    heads = (
        "recording",
        "pipeline",
        *map("{}_{}".format, NAMES, (u.replace("/", "_") for u in UNITS)),
    )
    table = [
        heads,
        *((*key, *(map(digits, row) if row else [REFUSED])) for key, row in rows.items()),
    ]
    widths = [max(len(line[k]) for line in table if len(line) > k) for k in range(len(heads))]
    lines = (
        " ".join(word.ljust(width) for word, width in zip(line, widths, strict=False))
        for line in table
    )
    return "".join(f"{line.rstrip()}\n" for line in lines)


def digits(value: float) -> str:
    """Return ``value`` with four digits, and no more than three behind the point."""
    if not isfinite(value):
        return "-"
    return f"{round(float(f'{value:.4g}'), 3) + 0.0:.10g}"


def read_text(text: str) -> dict[Key, Row]:
    """Return the rows of a text of `write_text`."""
    rows: dict[Key, Row] = {}
    for line in text.splitlines()[1:]:
        recording, pipeline, *words = line.split()
        refused = words == [REFUSED]
        rows[recording, pipeline] = (
            () if refused else tuple(nan if w == "-" else float(w) for w in words)
        )
    return rows


def compare(stored: Mapping[Key, Row], made: Mapping[Key, Row]) -> list[str]:
    """Return a line for each number of ``made`` that is not that of ``stored`` within tolerance."""
    lines = []
    for key, new in made.items():
        old = stored.get(key)
        if old is None:
            lines.append(f"{' '.join(key)}: not stored")
        elif not (old and new):
            if old != new:
                lines.append(f"{' '.join(key)}: {'now taken' if new else 'now refused'}")
        else:
            lines += [f"{' '.join(key)} {line}" for line in _differences(old, new)]
    return lines


def _differences(old: Row, new: Row) -> Iterator[str]:
    for name, unit, before, after in zip(NAMES, UNITS, old, new, strict=True):
        if isnan(before) and isnan(after):
            continue
        if not abs(after - before) <= SHARE * abs(before) + FLOORS[unit]:
            relative = (after - before) / abs(before) if before else nan
            share = f" ({relative:+.2%})" if isfinite(relative) else ""
            yield f"{name}: {digits(before)} became {digits(after)} {unit}{share}"


def main() -> int:
    """Write the file, or print the differences from it; return the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--write", action="store_true", help="write the file anew")
    parser.add_argument("--recording", action="append", choices=RECORDINGS, help="this one alone")
    parser.add_argument("--pipeline", action="append", choices=floatref.pipelines())
    asked = parser.parse_args()
    if asked.write and (asked.recording or asked.pipeline):
        parser.error("--write writes all; leave out --recording and --pipeline")
    recordings = asked.recording or tuple(RECORDINGS)
    made = dict(make_rows(recordings, asked.pipeline or tuple(floatref.pipelines())))
    stored = read_text(FILE.read_text(encoding="ascii")) if FILE.exists() else {}
    if asked.write:
        with replace_file(FILE, overwrite=True) as beside:
            beside.write_text(write_text(made), encoding="ascii")
    lines = compare(stored, made)
    if not (asked.recording or asked.pipeline):
        lines += [f"{' '.join(key)}: no longer made" for key in stored if key not in made]
    print("\n".join([*lines, f"{len(lines)} differences in {len(made)} rows"]))
    if lines and not asked.write:
        print(f"a difference is no error in itself: look at it, then {COMMAND}")
    return 1 if lines and not asked.write else 0


if __name__ == "__main__":
    sys.exit(main())
