"""NovAtel logs: every fix comes back, wherever in a file its logs lie."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.drawn_fixes import draw_fixes
from tests.adapters.formats.novatel.files_of_logs import NOW_MS, ONE, WEEK_MS, opened

from floatref_adapters.formats.novatel.adapter import NovAtel
from floatref_adapters.shared.text_lines import BLOCK
from floatref_adapters.testing.fixes import Fixes
from floatref_adapters.testing.novatel import ascii_log, binary_log, long_log
from floatref_adapters.testing.whole_reading import stream_of, table_of


@st.composite
def fixes(draw: st.DrawFn) -> Fixes:
    """Draw fixes, many of them across the end of a GPS week."""
    start = draw(st.sampled_from([1024, 2048, 2300])) * WEEK_MS + draw(st.integers(-3000, 3000))
    return draw_fixes(draw, start, [5, 50, 1000], 4)


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(
    drawn=fixes(),
    form=st.sampled_from([b"\n", b"\r", b"\r\n", b""]),
    junk=st.sampled_from([b"", b"\r\n<OK\r\n[ICOM1]", b"\xaaD\x12", b"#BESTPOSA,", b"\n\n"]),
)
def test_every_fix_comes_back(
    tmp_path_factory: pytest.TempPathFactory, drawn: Fixes, form: bytes, junk: bytes
) -> None:
    log = ascii_log(drawn, form) if form else binary_log(drawn)
    file = opened(tmp_path_factory.mktemp("novatel"), junk + b"\n" + log + junk)
    position, ticks = table_of(stream_of(file, "BESTPOS"))
    velocity, _ = table_of(stream_of(file, "BESTVEL"))
    np.testing.assert_array_equal(ticks, drawn.ms)
    text = bool(form)
    single = np.spacing(np.float32(107))
    height = np.array(drawn.altitude_m) + drawn.separation_m
    for found, expected, quantum in (
        (position["latitude"], drawn.latitude_deg, text * 0.51e-11),
        (position["longitude"], drawn.longitude_deg, text * 0.51e-11 + 3e-14),
        (position["height"], drawn.altitude_m, text * 0.51e-4),
        (position["ellipsoidal_height"], height, text * 0.51e-4 + single),
        (position["quality"], drawn.quality, 0),
        (velocity["quality"], drawn.quality, 0),
        (velocity["horizontal_speed"], drawn.speed_m_s, text * 0.51e-4),
        (velocity["ground_track"], drawn.course_deg, text * 0.51e-6),
        (velocity["z"], drawn.up_m_s, text * 0.51e-4),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=quantum)


@pytest.mark.slow
def test_logs_across_the_blocks_of_a_large_file_are_all_found(tmp_path: Path) -> None:
    log = binary_log(ONE) + ascii_log(ONE) + b"[ICOM1]"
    times = 3_500_000 // len(log)
    file = opened(tmp_path, log * times)
    assert {s.name: s.count for s in file.streams} == {"BESTPOS": 2 * times, "BESTVEL": 2 * times}
    assert (
        f"{7 * times} bytes between logs (prompts, answers, damaged logs): not read"
        in file.warnings
    )


def test_the_clock_counts_on_over_the_end_of_a_week(tmp_path: Path) -> None:
    body = binary_log(ONE)[28:100]
    log = b"".join(long_log(42, NOW_MS + ms, body) for ms in (-100, -50, 0, 50))
    _, ticks = table_of(stream_of(opened(tmp_path, log), "BESTPOS"))
    assert [b - a for a, b in pairwise(ticks.tolist())] == [50] * 3


@pytest.mark.slow
@pytest.mark.parametrize("ahead", [1, 2, 3, 9, 15, 27, 60, 103])
@pytest.mark.parametrize("log", [binary_log(ONE), ascii_log(ONE), ascii_log(ONE, b"\n")])
def test_a_log_that_begins_in_one_block_and_ends_in_the_next_is_found(
    tmp_path: Path, log: bytes, ahead: int
) -> None:
    file = opened(tmp_path, b"." * (BLOCK - ahead) + log)
    assert {s.name: s.count for s in file.streams} == {"BESTPOS": 1, "BESTVEL": 1}
    assert f"{BLOCK - ahead} bytes between logs" in file.warnings[0]


def test_a_binary_log_of_any_week_and_status_is_recognised(tmp_path: Path) -> None:
    path = tmp_path / "run.gps"
    for week in range(2300, 2300 + 256):
        path.write_bytes(binary_log(replace(ONE, ms=[week * WEEK_MS])))
        assert NovAtel().recognises(path), week
    for status in (20, 60, 180, 240):
        path.write_bytes(long_log(42, NOW_MS, bytes(72), status))
        assert NovAtel().recognises(path), status
