"""What cannot be read through a map is one line that names file, channel and value."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.errors import InputError
from floatref.mapping import read_native
from floatref.mapping.channel_map.entries import ChannelEntry, ClockEntry
from floatref.values.native import Epoch, NativeFile

Put = Callable[..., Path]
HEIGHT = ChannelEntry("laser", "height", unit="mm")
pytestmark = pytest.mark.usefixtures("nothing_left")


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        (ChannelEntry("lasre", "height", unit="mm"), "'lasre' is not in the file; did you mean"),
        (ChannelEntry("laser", "height"), "s/laser as height: the file gives no unit"),
        (
            ChannelEntry("laser", "height", unit="deg"),
            "s/laser as height: unit 'deg' is not a unit of",
        ),
        (
            ChannelEntry("laser", "distance", unit="m", wrap=2, track="left"),
            "s/laser as left.distance: wrap is 2, but a sample is 300; correct wrap",
        ),
        (
            ChannelEntry("laser", "yaw_rate", unit="rad/s"),
            "s/laser as yaw_rate: a sample is 300 rad/s, which no vehicle reaches",
        ),
    ],
)
def test_a_refusal_names_file_and_channel_once(
    put: Put, make_stream, entry: ChannelEntry, message: str, chart, refused
) -> None:
    source = put(make_stream("s", {"laser": [250.0, 300.0]}, rate=Fraction(100)))
    line = refused(InputError, source, chart(entry))
    assert line.startswith(f"{source}: {message}")
    assert line.count(str(source)) == 1


def test_names_that_would_break_a_line_do_not(put: Put, make_stream, chart, refused) -> None:
    evil = "a\nb\x1b[31m\u2028"
    source = put(
        make_stream(evil, {evil: [1.0, 2.0]}, rate=Fraction(100), count=9),
        warnings=("bad\nline\x1b",),
    )
    assert "there are a\\nb" in refused(InputError, source, chart(ChannelEntry("q\nq", "height")))
    reading = read_native(source, chart(ChannelEntry(evil, "height", unit="m")))
    assert len(reading.warnings) == 2
    assert all(line.isprintable() for line in reading.warnings)


def test_time_that_goes_back_is_refused_with_its_stream(
    put: Put, make_stream, chart, refused
) -> None:
    ticks = [*range(10), *range(10)]
    source = put(make_stream("s", {"laser": np.ones(20)}, ticks=ticks))
    line = refused(InputError, source, chart())
    assert line.startswith(f"{source}: ")
    assert "time goes back in 9 of 20 rows" in line


def test_another_epoch_in_the_middle_is_told(put: Put, make_stream, chart) -> None:
    ticks = [*range(0, 1000, 10), *range(1_700_000_000, 1_700_001_000, 10)]
    source = put(make_stream("gps", {"laser": np.full(200, 300.0)}, ticks=ticks))
    (line,) = read_native(source, chart()).warnings
    assert line.startswith("run.log: stream 'gps': no rows for 1.7e+09 s after row 99; if")


def test_a_clock_of_a_stream_that_is_not_there_is_refused(
    put: Put, make_stream, chart, refused
) -> None:
    source = put(make_stream("laser", {"laser": [1.0, 2.0]}, rate=Fraction(100)))
    lost = chart(clocks=(ClockEntry(stream="lasre", rate=Fraction(5)),))
    line = refused(InputError, source, lost)
    assert "no stream is called 'lasre'; did you mean laser?" in line


def test_a_stated_rate_and_start_are_those_of_the_recording(
    put: Put, make_stream, chart, refused
) -> None:
    source = put(
        make_stream("a", {"laser": np.ones(5)}, name="unknown"),
        make_stream("b", {"x": np.ones(5)}, ticks=[7, 7, 7, 7, 7]),
    )
    refused(InputError, source, chart())
    by_stream = (
        ClockEntry(stream="a", rate=Fraction(100, 3), start_s=2.5),
        ClockEntry(rate=Fraction(50)),
    )
    x = ChannelEntry("x", "gnss_height", unit="m")
    height, other = (
        read_native(source, chart(entry, clocks=by_stream)).recording.channels[0]
        for entry in (HEIGHT, x)
    )
    assert (height.clock.rate, height.clock.start_s) == (Fraction(100, 3), 2.5)
    assert (other.clock.rate, other.clock.start_s) == (50, 7.0)


def test_a_source_that_is_not_there_or_of_no_adapter_is_named(
    tmp_path: Path, logger, chart, refused
) -> None:
    for name in ("no.log", "x" * 300):
        assert refused(InputError, tmp_path / name, chart()).endswith(": not found")
    (tmp_path / "run.xyz").write_bytes(b"")
    assert "no adapter recognises it" in refused(InputError, tmp_path / "run.xyz", chart())
    line = refused(InputError, tmp_path / "run.xyz", chart(), "logr")
    assert "adapter logr: unknown; did you mean logger?" in line


def test_paths_may_be_text_and_the_public_name_is_the_same(
    put: Put, make_stream, tmp_path: Path
) -> None:
    assert floatref.read_native is read_native
    source = put(make_stream("s", {"laser": [250.0, 251.0]}, rate=Fraction(100)))
    text = 'format = "floatref-map/1"\n[[channels]]\nnative = "laser"\nchannel = "height"\n'
    (tmp_path / "map.toml").write_text(text + 'unit = "mm"\n')
    reading = floatref.read_native(str(source), str(tmp_path / "map.toml"))
    assert reading.recording.channel("height").values.tolist() == [0.25, 0.251]
    assert dict(reading.files) == {"": source}


def test_streams_of_one_absolute_clock_keep_their_distance_in_time(
    put: Put, make_stream, chart
) -> None:
    clock = {"epoch": Epoch.UTC, "origin_ns": 1_700_000_000 * 10**9 + 250}
    source = put(
        make_stream("a", {"laser": np.ones(5)}, rate=Fraction(10), **clock),
        make_stream("b", {"x": np.ones(3)}, ticks=[1, 15, 51], tick_s=Fraction(1, 10), **clock),
    )
    both = (HEIGHT, ChannelEntry("x", "gnss_height", unit="m"))
    height, other = read_native(source, chart(*both)).recording.channels
    np.testing.assert_allclose(other.times_s - height.times_s[0], [0.1, 1.5, 5.1], atol=1e-9)


def test_a_file_without_streams_is_refused(put: Put, chart, refused) -> None:
    assert "it has no columns" in refused(InputError, put(), chart())
    assert "no channel of it has a name of floatref's" in refused(InputError, put())
    assert NativeFile(()).streams == ()
