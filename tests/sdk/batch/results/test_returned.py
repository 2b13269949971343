"""What tasks return is what the summary is made of, whatever the disk shows."""

from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.batch.jobs.job import Job
from floatref.batch.results.record import Record, Row, returned_records
from floatref.errors import InputError

FULL = Path("/dev/full")


def record(index: int, warning: str) -> Record:
    row = Row("left", index, 0.1 * index, 1.0, 52.0, 4.0, 1.0 / 3.0, 2.0, 0.0)
    return Record(f"a/run{index}", f"/in/run{index}", rows=(row,) * index, warnings=(warning,))


@pytest.mark.slow
@given(st.permutations(range(5)), st.permutations(range(5)), st.text())
def test_records_come_back_in_the_order_of_the_jobs(
    tmp_path_factory: pytest.TempPathFactory, done: list[int], given: list[int], warning: str
) -> None:
    out = tmp_path_factory.getbasetemp()
    with returned_records(out) as returned:
        returned.add(record(done[0], "replaced"))
        for index in done:
            returned.add(record(index, warning))
        jobs = [Job(out, f"a/run{index}", out) for index in given]
        # As texts: a NaN is not equal to itself in a dataclass, from Python 3.13 on.
        expected = [repr(record(index, warning)) for index in given]
        assert list(map(repr, returned.of(jobs))) == expected


def test_nothing_of_it_is_left(tmp_path: Path) -> None:
    with suppress(KeyboardInterrupt), returned_records(tmp_path) as returned:
        returned.add(record(1, ""))
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not FULL.exists(), reason="there is no disk that is always full")
def test_a_full_disk_is_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "floatref.batch.results.record.TemporaryFile",
        lambda **_: FULL.open("w+b", buffering=1 << 20),
    )
    line = r"cannot be written \(No space left on device\); free space there"
    with pytest.raises(InputError, match=line), returned_records(tmp_path) as returned:
        returned.add(record(1, ""))
