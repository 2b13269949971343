"""Recordings as CSV tables: what is written is read, what is no such table is refused."""

import io
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import floatref
from floatref import InputError, UniformClock
from floatref.architectures.plugins import plugins
from floatref_adapters.csv_recording import CsvRecording

SHARED = ("distance", "pitch_rate", "gnss_height")
PER_TRACK = ("vertical_specific_force", "height", "lateral_specific_force")
samples = st.none() | st.floats(-1e6, 1e6) | st.floats(-1e-6, 1e-6)
tracks = st.text("abcXYZ09_- .äß", min_size=1, max_size=6).filter(
    lambda name: name == name.strip() and not name.endswith(".")
)


@st.composite
def columns(draw: st.DrawFn) -> dict[str, list[float | None]]:
    """Draw columns of one length, at least one, NaN written as an empty field."""
    names = draw(st.lists(st.sampled_from(SHARED), unique=True))
    for track in draw(st.lists(tracks, unique=True, min_size=not names, max_size=2)):
        names += [f"{track}.{name}" for name in PER_TRACK]
    rows = draw(st.integers(2, 12))
    return {n: draw(st.lists(samples, min_size=rows, max_size=rows)) for n in names}


def table(given_columns: dict[str, list[float | None]], rate: float, start: float) -> str:
    """Return the CSV table of ``given_columns``."""
    out = io.StringIO()
    out.write(",".join(["time_s", *given_columns]) + "\n")
    for k, row in enumerate(zip(*given_columns.values(), strict=True)):
        fields = ["" if x is None else repr(x) for x in row]
        out.write(",".join([f"{start + k / rate:.9f}", *fields]) + "\n")
    return out.getvalue()


@settings(deadline=None, max_examples=60)
@given(
    drawn=columns(),
    rate=st.sampled_from([50.0, 1000.0, 3240.0, 16000.0]),
    start=st.integers(-5, 50_000),
    ending=st.sampled_from(["\n", "\r\n"]),
    mark=st.sampled_from(["", "\ufeff"]),
)
def test_every_sample_comes_back(
    tmp_path_factory: pytest.TempPathFactory,
    drawn: dict[str, list[float | None]],
    rate: float,
    start: int,
    ending: str,
    mark: str,
) -> None:
    path = tmp_path_factory.mktemp("csv") / "run.csv"
    text = mark + table(drawn, rate, start).replace("\n", ending)
    path.write_bytes(text.encode())
    assert CsvRecording().recognises(path)
    recording = CsvRecording().read(path)
    assert [str(c.id) for c in recording.channels] == list(drawn)
    for channel in recording.channels:
        expected = [np.nan if x is None else x for x in drawn[str(channel.id)]]
        np.testing.assert_array_equal(channel.values, expected)
        assert isinstance(channel.clock, UniformClock)
        np.testing.assert_allclose(
            channel.times_s, start + np.arange(len(expected)) / rate, rtol=0, atol=2e-9
        )


def read(tmp_path: Path, text: str | bytes) -> floatref.Recording:
    """Return what the adapter reads from a file that holds ``text``."""
    path = tmp_path / "run.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return CsvRecording().read(path)


REFUSED = {
    "": "first column is ''; it must be time_s, in s",
    "time_s\n0\n1\n": "column time_s stands alone; add one column per channel",
    "distance,time_s\n0,0\n": "first column is 'distance'; it must be time_s, in s",
    "time_s,distance\n": "no rows below the header; copy the complete file",
    "time_s;distance\n0,1;0,2\n": "not separated by commas; export with commas and decimal points",
    "time_s,distance\n0,1,0,2\n": "row 2 has 4 fields, the header 2; write decimal points",
    'time_s,distance\n0,"0,5"\n': "row 2: distance is '0,5'; write a decimal point, not a decimal",
    "time_s,distance\n0,0\n0.1\n": "row 3 has 1 fields, the header 2; the file is truncated",
    "time_s,distance\n0,0\n0.1,fast\n": "row 3: distance is 'fast'; write a number",
    "time_s,distance\n0,0\n,1\n": "row 3: time_s is ''; every row needs its time",
    "time_s,distance\n-1e308,0\n1e308,1\n": "row 2: time_s is '-1e308'; every row needs its time",
    "time_s,distance\n0,0\n1.1e12,1\n": "time_s is '1.1e12'; every row needs its time in s, within",
    "time_s,distance\n0,0\n0,1\n": "times must increase",
    "time_s,distance\n0,0\n0.1,inf\n": "channel distance: sample 1 is infinite",
    "time_s,distance,distance\n0,0,0\n": "column distance: given twice; rename one of them",
    "time_s,left.heigth\n0,0\n1,1\n": "channel heigth: unknown name; did you mean height?",
    'time_s,distance\n0,"0\n': "not a CSV",
    b"time_s,distance\n0,\xff\n": "not UTF-8 text",
}


@pytest.mark.parametrize("text", REFUSED, ids=range(len(REFUSED)))
def test_anything_else_is_refused_in_one_line(tmp_path: Path, text: str | bytes) -> None:
    with pytest.raises(InputError) as caught:
        read(tmp_path, text)
    assert REFUSED[text] in str(caught.value)
    assert "run.csv" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_folder_and_a_missing_file_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.csv"):
        assert not CsvRecording().recognises(path)
        with pytest.raises(InputError, match="not a file"):
            CsvRecording().read(path)


def test_our_own_profile_table_is_not_taken_for_a_recording(tmp_path: Path) -> None:
    profile = floatref.Profile(0.05, (floatref.ProfileTrack.of("main", np.zeros(5)),))
    floatref.write_profile_csv(profile, tmp_path / "profile.csv")
    assert not CsvRecording().recognises(tmp_path / "profile.csv")


def test_floatref_finds_the_adapter_through_its_entry_point() -> None:
    assert plugins().adapters()["csv"].summary == CsvRecording.summary


def test_a_table_is_processed_as_its_recording_directory_is(tmp_path: Path) -> None:
    rate, speed, n = 1000.0, 20.0, 2000
    t = np.arange(n) / rate
    force, height = 9.80665 + 0.3 * np.sin(9 * t), 0.3 - 0.004 * np.sin(9 * t)
    rows = zip(t.tolist(), force.tolist(), height.tolist(), (speed * t).tolist(), strict=True)
    text = "time_s,vertical_specific_force,height,distance\n"
    text += "".join(",".join(map(repr, row)) + "\n" for row in rows)
    clock = UniformClock.of(rate)
    names = ("vertical_specific_force", "height", "distance")
    arrays = (force, height, speed * t)
    channels = [floatref.Channel.of(*c, clock) for c in zip(names, arrays, strict=True)]
    expected = floatref.process(floatref.Recording(tuple(channels)))
    found = floatref.process(read(tmp_path, text))
    np.testing.assert_array_equal(found.tracks[0].elevation, expected.tracks[0].elevation)
