"""Fuzz the CSV reader: any bytes are a table, or one `InputError` of one line.

Run it as `harness` says. The first byte chooses what a channel map would state of the table. A
table that is read has as many rows as it was counted to have, in every column, read twice the same.
"""

from collections.abc import Mapping

from harness import fuzz, instrumented, one_line, scratch

with instrumented():
    import numpy as np

    from floatref import Stream
    from floatref_adapters.formats.csv_table.adapter import CsvTable

TABLE = scratch("csv") / "a.csv"
OPTIONS: tuple[Mapping[str, str], ...] = (
    {},
    {"delimiter": ";"},
    {"delimiter": ";", "decimal": ","},
    {"time": "a"},
    {"time": "Zeit", "epoch": "utc"},
    {"delimiter": "\t"},
)
SEEDS = (
    b"\x00time_s,left.height,distance\n0.0000625,0.3,1e-3\n0.000125,,2\n",
    b"\x00Zeit [s];H\xc3\xb6he [mm];Weg\r\n0,001;-1,5;NaN\r\n0,002;2,5;3\r\n",
    b"\x01# logger\nsep=;\ntime;a;b\ns;mm;g\n1;2;3\n2;3;4\n",
    b"\x002026-11-22T10:00:00.5Z 1 2\n2026-11-22T10:00:01.5Z 3 4\n",
    b'\x00"a, b",c\n"1",2\n"3",4',
    b"\x00\xff\xfet\x00;\x00a\x00\n\x001\x00;\x002\x00\n\x00",
    b"\x0322.11.2026 10:00:00,123\t1\n22.11.2026 10:00:00,124\t2\n",
)


def read_any(data: bytes) -> None:
    chosen = OPTIONS[data[0] % len(OPTIONS)] if data else {}
    TABLE.write_bytes(data[1:])
    CsvTable().recognises(TABLE)
    one_line(check_all, chosen)


def check_all(chosen: Mapping[str, str]) -> None:
    with CsvTable().streams(TABLE, chosen) as native:
        for stream in native.streams:
            check(stream)


def check(stream: Stream) -> None:
    """Raise AssertionError unless all columns have the rows that were counted, twice the same."""
    names = [column.name for column in stream.columns if column.numeric]
    once, again = ([*stream.read(names)] for _ in range(2))
    for name in names:
        values = np.concatenate([rows.values[name] for rows in once]) if once else np.empty(0)
        if values.size != stream.count:
            raise AssertionError(f"{values.size} rows of {stream.count}")
    for one, other in zip(once, again, strict=True):
        for name in names:
            if one.values[name].tobytes() != other.values[name].tobytes():
                raise AssertionError("the second reading differs")


if __name__ == "__main__":
    fuzz("csv", read_any, SEEDS)
