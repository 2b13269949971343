"""Waveforms of TDMS: every row has the time of its own."""

from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Epoch
from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing.tdms import (
    META,
    NEW,
    RAW,
    UNIX_S,
    Properties,
    doubles,
    segment,
    waves,
)
from floatref_adapters.testing.whole_reading import read_whole

read = partial(read_whole, Tdms())


def test_a_waveform_gives_the_rate_the_start_and_the_offset(tmp_path: Path) -> None:
    wave: Properties = {
        "wf_increment": 6.25e-05,
        "wf_start_offset": 0.25,
        "wf_start_time": (UNIX_S + 1_700_000_000, 1 << 63),
    }
    (tmp_path / "a.tdms").write_bytes(segment(META | NEW | RAW, doubles(1, 2, wave), bytes(16)))
    native, _ = read(tmp_path / "a.tdms")
    clock = native.streams[0].clock
    assert clock.rate == 16_000
    assert clock.first_tick * clock.tick_s == Fraction(1, 4)
    assert (clock.epoch, clock.origin_ns) == (Epoch.UTC, 1_700_000_000_500_000_000)


def test_the_zero_of_labview_is_no_start_and_a_spectrum_has_no_time(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    wave: Properties = {"wf_increment": 0.5, "wf_start_time": (0, 0)}
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 2, wave), bytes(16)))
    assert read(path)[0].streams[0].clock.epoch is Epoch.LOCAL
    wave = {"wf_increment": 0.5, "wf_xunit_string": "Hz"}
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 2, wave), bytes(16)))
    assert read(path)[0].streams[0].clock.name == "unknown"


def starting(ns: int, step_s: float) -> Properties:
    """Return a waveform that begins so many ns after 1.7e9 s since 1970."""
    seconds, rest = divmod(ns, 10**9)
    start = (UNIX_S + 1_700_000_000 + seconds, (rest << 64) // 10**9)
    return {"wf_increment": step_s, "wf_start_time": start}


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(
    parts=st.lists(
        st.tuples(st.integers(1, 5), st.integers(1, 10**6), st.integers(0, 10**10)),
        min_size=2,
        max_size=5,
    )
)
def test_every_row_has_the_time_of_its_own_waveform(
    tmp_path_factory: pytest.TempPathFactory, parts: list[tuple[int, int, int]]
) -> None:
    """Each is some values, a step of so many us, and a pause of so many ns before it."""
    now, expected, written = 0, [], []
    for count, step_us, pause_ns in parts:
        now += pause_ns
        written.append((count, starting(now, step_us / 1e6)))
        expected += [now + k * step_us * 1000 for k in range(count)]
        now += count * step_us * 1000
    path = tmp_path_factory.mktemp("tdms") / "a.tdms"
    path.write_bytes(waves(written))
    native, [(values, ticks)] = read(path)
    clock = native.streams[0].clock
    if ticks is None:
        assert clock.rate is not None
        ticks = np.array([round(k / clock.rate * 10**9) for k in range(len(values["c0"]))])
    within = max(step for _, step, _ in parts) * 500 + 1
    assert np.abs(ticks + clock.origin_ns - 1_700_000_000 * 10**9 - expected).max() <= within
    alone = [rows.ticks for rows in native.streams[0].read([])]
    assert sum(len(part) for part in alone) == (len(expected) if clock.rate is None else 0)


def test_a_start_that_is_stated_again_as_recording_goes_on_is_no_new_waveform(
    tmp_path: Path,
) -> None:
    path = tmp_path / "a.tdms"
    path.write_bytes(waves([(4, starting(k * 4_000_000, 0.001)) for k in range(5)]))
    native, [(values, ticks)] = read(path)
    clock = native.streams[0].clock
    assert (clock.rate, clock.origin_ns, ticks) == (1000, 1_700_000_000 * 10**9, None)
    assert (len(values["c0"]), native.warnings) == (20, ())


def test_a_pause_between_waveforms_is_kept_and_told(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    path.write_bytes(waves([(2, starting(0, 0.001)), (2, starting(10**9, 0.001))]))
    native, [(_, ticks)] = read(path)
    assert ticks.tolist() == [0, 1_000_000, 1_000_000_000, 1_001_000_000]
    assert native.warnings == ("g: 2 waveforms one after the other",)
    path.write_bytes(waves([(2, {"wf_increment": 0.5}), (2, {"wf_increment": 0.25})]))
    assert read(path)[1][0][1].tolist() == [0, 500_000_000, 1_000_000_000, 1_250_000_000]
    path.write_bytes(waves([(2, {"wf_increment": 0.5}), (2, {"wf_increment": 0.0})]))
    assert read(path)[0].streams[0].clock.name == "unknown"
