"""TDMS that is damaged or something else: read as far as it goes, or refused in one line."""

import contextlib
import random
import struct
import sys
from functools import partial
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from tests.adapters.damage import with_wrong_numbers

from floatref import InputError
from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing.tdms import (
    INTERLEAVED,
    META,
    NEW,
    RAW,
    doubles,
    lay_out,
    scale_waveform,
    segment,
)
from floatref_adapters.testing.whole_reading import read_whole, refusal

read = partial(read_whole, Tdms())
refused = partial(refusal, Tdms())


@pytest.mark.slow
@pytest.mark.parametrize("interleaved", [False, True])
def test_a_damaged_file_is_refused_or_read_and_nothing_else(
    tmp_path: Path, interleaved: bool
) -> None:
    path, draw = tmp_path / "a.tdms", random.Random(interleaved)
    raw = lay_out(np.arange(18.0).reshape(3, 6), 3, interleaved)
    wave = scale_waveform("Linear")
    sound = segment(META | NEW | RAW | INTERLEAVED * interleaved, doubles(3, 3, wave), raw)
    sound += segment(RAW | INTERLEAVED * interleaved, b"", raw)
    for damaged in islice(with_wrong_numbers(sound, draw, 4), 250):
        path.write_bytes(damaged)
        with contextlib.suppress(InputError):
            _, numbers = read(path)
            held = sum(len(v) for values, _ in numbers for v in values.values())
            assert held <= len(sound)


def test_a_text_longer_than_any_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    metadata = struct.pack("<II", 1, 2**31) + bytes(100)
    path.write_bytes(segment(META | NEW, metadata, b""))
    assert "a text of 2147483648 bytes" in refused(path)


def test_what_is_no_tdms_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    for start in (b"", b"TDSm", b"MDF     4.10" + bytes(80), b"TDSm" + bytes(24) + b"x" * 40):
        path.write_bytes(start)
        assert Tdms().recognises(path) == (start[:4] == b"TDSm")
        refused(path)
    assert not Tdms().recognises(tmp_path / "none.tdms")
    assert "check the name" in refused(tmp_path / "none.tdms")


def test_without_nptdms_one_line_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.tdms"
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 2), bytes(16)))
    monkeypatch.setitem(sys.modules, "nptdms", None)
    assert 'needs nptdms; run in a clone of floatref: pip install -e ".[adapters]"' in refused(path)


@pytest.mark.parametrize("left", [28, 29, 40, 60])
def test_a_file_cut_within_its_first_metadata_is_refused(tmp_path: Path, left: int) -> None:
    path = tmp_path / "a.tdms"
    wave = scale_waveform("Linear")
    raw = lay_out(np.arange(18.0).reshape(3, 6), 3, False)
    sound = segment(META | NEW | RAW, doubles(3, 3, wave), raw)
    path.write_bytes(sound[:left])
    assert "cut off before the first value" in refused(path)
