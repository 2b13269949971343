"""What `batch` prints: names come from files, and none of them commands a terminal."""

from pathlib import Path

import pytest

from floatref.batch.results.record import Row
from floatref.batch.results.totals import Tally
from floatref.cli.batch.batch_report import print_report, tell_remarks, tell_warnings

HOSTILE = "a\x1b[31m\r\x07b"
"""A name that would colour a terminal, go back to the start of the line, and ring."""
ROW = Row(HOSTILE, 0, 0.0, 160.0, 0.0, 0.0, 2.0, 2.0, 0.0, 2.0, 1.0)
DOCUMENT = {
    "files": {"found": 2, "done": 1, "failed": 1, "skipped": 0},
    "this_run": {"wall_s": 1.0, "workers": 1, "processed": 2, "length_km": 0.2},
    "effort": {"cpu_s": 1.0, "peak_bytes": 1_000_000},
    "failures": [{"name": HOSTILE, "error": "damaged"}],
    "pipelines": {"best": 1},
    "warnings": 1,
    "length_km": 0.2,
}


def test_a_hostile_name_is_printed_as_text(capsys: pytest.CaptureFixture[str]) -> None:
    tally = Tally(failed={HOSTILE: "damaged"}, first_warnings=[(HOSTILE, "short")], warnings=1)
    tally.roughest = [(2.0, HOSTILE, ROW)]
    for tell in (
        lambda: print_report(DOCUMENT, tally, Path("out")),
        lambda: tell_warnings(tally),
        lambda: tell_remarks([Path(HOSTILE)], []),
        lambda: tell_remarks([], [HOSTILE]),
    ):
        tell()
        printed = "".join(capsys.readouterr())
        assert all(letter.isprintable() or letter == "\n" for letter in printed), ascii(printed)
        assert "[31m" in printed
