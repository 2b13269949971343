"""Pages of Parquet are as large as their file says, or the file is refused before it swells.

Law: whatever a few bytes declare, reading takes no more than a bounded share of memory.
"""

import contextlib
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError, Profile, ProfileTrack
from floatref_adapters.formats.arrow.adapter import Parquet
from floatref_adapters.formats.arrow.parquet_pages import ALWAYS, LARGEST_RATIO, check_pages
from floatref_adapters.formats.arrow.parquet_profile import ParquetProfile
from floatref_adapters.formats.arrow.thrift_compact import Compact

HUGE = b"\xfe\xff\xff\xff\x0f"
"""2^31 - 1, as the compact protocol writes it."""
MOST_KIB = 256 << 10
READ = """
import sys
from pathlib import Path
from floatref import InputError
from floatref_adapters.formats.arrow.adapter import Parquet
for name in sys.argv[1:]:
    try:
        for stream in Parquet().streams(Path(name), {}).streams:
            for rows in stream.read([c.name for c in stream.columns if c.numeric]):
                pass
    except InputError:
        pass
# What getrusage counts begins with the memory of the process that started this one.
status = Path("/proc/self/status").read_text().splitlines()
print(next(line.split()[1] for line in status if line.startswith("VmHWM")))
"""


def write(path: Path, version: str, compression: str) -> bytes:
    """Write a table of few values to ``path``; return its bytes."""
    table = pa.table({"time_s": np.arange(400) / 100, "a": np.arange(400) % 5.0})
    pq.write_table(table, path, compression=compression, data_page_version=version)
    return path.read_bytes()


@pytest.mark.parametrize("version", ["1.0", "2.0"])
@pytest.mark.parametrize("compression", ["none", "snappy", "zstd"])
def test_sound_pages_pass(tmp_path: Path, version: str, compression: str) -> None:
    write(tmp_path / "a.parquet", version, compression)
    with (tmp_path / "a.parquet").open("rb") as file:
        check_pages(file, ["time_s", "a"])


@pytest.mark.parametrize("version", ["1.0", "2.0"])
@pytest.mark.parametrize("field", [2, 3])
def test_a_page_that_declares_two_gigabytes_is_refused(
    tmp_path: Path, version: str, field: int
) -> None:
    path = tmp_path / "a.parquet"
    sound = write(path, version, "zstd")
    first = pq.read_metadata(path).row_group(0).column(0)
    at = min(first.data_page_offset, first.dictionary_page_offset or first.data_page_offset)
    path.write_bytes(with_field(sound, at, field))
    (stream,) = Parquet().streams(path, {}).streams
    with pytest.raises(InputError, match=r"column time_s: (a page of|no page at)"):
        list(stream.read(["a"]))


def test_a_page_that_unpacks_to_more_than_its_bytes_can_be_is_refused(tmp_path: Path) -> None:
    """Its header and the footer agree, so that the file is sound."""
    path = tmp_path / "a.parquet"
    table = pa.table({"a": [bytes(ALWAYS // 2 + 1)] * 2})
    pq.write_table(table, path, compression="zstd", use_dictionary=False)
    assert path.stat().st_size < ALWAYS // LARGEST_RATIO
    with path.open("rb") as file, pytest.raises(InputError, match="or write smaller pages"):
        check_pages(file, ["a"])


@pytest.mark.parametrize("version", ["1.0", "2.0"])
@pytest.mark.parametrize("field", [2, 3])
def test_a_page_that_is_larger_than_its_column_is_refused(
    tmp_path: Path, version: str, field: int
) -> None:
    """All fields behind it are where they were: nothing else is wrong with the file."""
    path = tmp_path / "a.parquet"
    sound = write(path, version, "zstd")
    begin, end = place_of(sound, 4, field)
    largest = b"\xfe" + b"\xff" * (end - begin - 2) + b"\x7f"
    path.write_bytes(sound[:begin] + largest + sound[end:])
    with path.open("rb") as file, pytest.raises(InputError, match="column time_s: a page of"):
        check_pages(file, ["time_s"])


def with_field(sound: bytes, at: int, field: int) -> bytes:
    """Return ``sound`` with `HUGE` over ``field``, 2 or 3, of the header of a page at ``at``."""
    begin, _ = place_of(sound, at, field)
    return sound[:begin] + HUGE + sound[begin + len(HUGE) :]


def place_of(sound: bytes, at: int, field: int) -> tuple[int, int]:
    """Return where ``field``, 2 or 3, of the header of a page at ``at`` begins and ends."""
    reader = Compact(sound[at:])
    # The kind of the page comes first, in a byte of its head and one of its value.
    reader.at = 2
    for _ in range(field - 2):
        reader.at += 1
        reader.integer()
    reader.at += 1
    begin = at + reader.at
    reader.integer()
    return begin, at + reader.at


def test_a_damaged_profile_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.parquet"
    track = ProfileTrack.of("left", np.arange(300.0))
    ParquetProfile().write(Profile(0.025, (track,)), path)
    path.write_bytes(with_field(path.read_bytes(), 4, 2))
    with pytest.raises(InputError, match=r"a\.parquet: column distance_m: "):
        ParquetProfile().read(path)


@given(st.binary(max_size=200))
def test_no_bytes_break_the_reader_of_structs(content: bytes) -> None:
    with contextlib.suppress(IndexError, KeyError):
        Compact(content).struct()


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the peak is read in /proc")
@settings(max_examples=3)
@given(st.randoms(use_true_random=False))
def test_bytes_overwritten_anywhere_take_little_memory(
    tmp_path_factory: pytest.TempPathFactory, draw
) -> None:
    folder = tmp_path_factory.mktemp("parquet")
    names = []
    for number in range(60):
        version, packed = draw.choice(["1.0", "2.0"]), draw.choice(["snappy", "zstd"])
        content = bytearray(write(folder / "sound.parquet", version, packed))
        at = draw.randrange(4, len(content) - 8)
        content[at : at + 8] = draw.choice([HUGE + b"\0\0\0", draw.randbytes(8)])
        names.append(str(folder / f"{number}.parquet"))
        Path(names[-1]).write_bytes(content)
    command = [sys.executable, "-c", READ, *names]
    found = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert int(found) < MOST_KIB
