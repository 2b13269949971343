"""Tables of text: every number comes back, whatever the writing."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.csv_table.files_of_text import read

from floatref_adapters.testing.whole_reading import make_columns as columns
from floatref_adapters.testing.whole_reading import ticks_of as ticks

pytestmark = pytest.mark.slow

samples = st.none() | st.floats(-1e6, 1e6) | st.floats(-1e-6, 1e-6)
few = settings(deadline=None, max_examples=80)
MISSING = ("", "nan", "NaN", "NA", "-", "n/a", "#DIV/0!", "#NUM!")


@few
@given(
    rows=st.lists(st.tuples(samples, samples, samples), min_size=2, max_size=12),
    delimiter=st.sampled_from([",", ";", "\t", "|", " ", "   "]),
    comma=st.booleans(),
    ending=st.sampled_from(["\n", "\r\n", "\r"]),
    encoding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "latin-1"]),
    quoted=st.booleans(),
    above=st.integers(0, 3),
    missing=st.sampled_from(MISSING),
)
def test_every_sample_comes_back_whatever_the_writing(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float | None, ...]],
    delimiter: str,
    comma: bool,
    ending: str,
    encoding: str,
    quoted: bool,
    above: int,
    missing: str,
) -> None:
    mark = "," if comma and delimiter != "," else "."
    missing = missing if delimiter.strip() else "NaN"

    def field(value: float | None) -> str:
        text = missing if value is None else repr(value).replace(".", mark)
        return f'"{text}"' if quoted else text

    lines = [f"# made by a logger {k}" for k in range(above)]
    lines.append(delimiter.join(["time_s", "a", "µ°b", "c"]))
    for k, row in enumerate(rows):
        time = f"{k / 8:.4f}".replace(".", mark)
        lines.append(delimiter.join([time, *map(field, row)]))
    text = "".join(line + ending for line in lines)
    native = read(tmp_path_factory.mktemp("csv"), text.encode(encoding))
    expected = [[np.nan if x is None else x for x in values] for values in zip(*rows, strict=True)]
    found = columns(native)
    assert list(found) == ["a", "µ°b", "c"]
    for values, wanted in zip(found.values(), expected, strict=True):
        np.testing.assert_array_equal(values, wanted)
    np.testing.assert_array_equal(ticks(native), 1250 * np.arange(len(rows)))
    assert native.streams[0].clock.tick_s == Fraction(1, 10_000)
    assert native.warnings == ((f"{above} lines above the table: skipped",) if above else ())


@few
@given(
    values=st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=2, max_size=40),
    shape=st.sampled_from(["{!r}", "{:.17e}", "{:.3f}", "{:+.6g}", " {!r} "]),
)
def test_numbers_are_read_as_python_reads_them(
    tmp_path_factory: pytest.TempPathFactory, values: list[float], shape: str
) -> None:
    texts = [shape.format(value) for value in values]
    text = "a,b\n" + "".join(f"{t},1\n" for t in texts)
    native = read(tmp_path_factory.mktemp("csv"), text)
    assert columns(native)["a"] == [float(t) for t in texts]


@pytest.mark.parametrize("size", [1 << 16, (1 << 16) + 1, 1 << 20])
def test_rows_over_the_edges_of_blocks_are_whole(tmp_path: Path, size: int) -> None:
    rng = np.random.default_rng(size)
    wanted = rng.normal(size=(60_000, 2))
    rows = "".join(f"{k / 1000:.3f},{a!r},{b!r}\r\n" for k, (a, b) in enumerate(wanted.tolist()))
    head = "time,a,b\r\n"
    pad = "# " + "x" * (size - len(head) - 5 - rows.find("\n")) + "\r\n"
    native = read(tmp_path, pad[: 1 << 15].rstrip() + "\r\n" + head + rows)
    found = columns(native)
    np.testing.assert_array_equal(np.column_stack([found["a"], found["b"]]), wanted)
    np.testing.assert_array_equal(ticks(native), np.arange(60_000))
