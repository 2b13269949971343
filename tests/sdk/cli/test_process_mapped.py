"""`floatref process` on native files: profile, provenance, and nothing left behind."""

import hashlib
import tempfile
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from floatref.files import read_profile, write_recording
from floatref.values.clock import UniformClock
from floatref.values.native import Column, NativeClock, NativeFile, Rows, Stream
from floatref.values.recording import Channel, Recording, Setup

G = 9.80665
RATE = 1000
TIMES = np.arange(8 * RATE) / RATE
RUN = {
    "distance": 20.0 * TIMES,
    "height": 0.3 + 0.005 * np.sin(15.0 * TIMES),
    "vertical_specific_force": G + 1e-3 * np.sin(15.0 * TIMES),
}
NATIVE = {"dmi": 1e3 * RUN["distance"], "laser": 1e3 * RUN["height"]}
FORCE = {"acc": RUN["vertical_specific_force"] / G}
MAP = """
format = "floatref-map/1"
[source]
dbc = "bus.dbc"
[setup]
profile_interval_m = 0.05
[[files]]
name = "force"
path = "more/run.log"
[[channels]]
native = "laser"
channel = "height"
unit = "mm"
[[channels]]
native = "dmi"
channel = "distance"
unit = "mm"
[[channels]]
native = "acc"
channel = "vertical_specific_force"
unit = "g"
file = "force"
[[clocks]]
align = "offset"
"""


PROCESS = ("process", "run.log", "--out", "out", "--map", "map.toml")


class Logger:
    """The adapter of files `*.log`, which hold two channels, or in a folder `more` the third."""

    name, summary = "logger", "a run in two files"
    error: BaseException | None = None

    def recognises(self, source: Path) -> bool:
        return source.suffix == ".log"

    def streams(self, source: Path, options: dict[str, str]) -> NativeFile:
        values = FORCE if source.parent.name == "more" else NATIVE

        def read(names: Sequence[str]) -> Iterator[Rows]:
            for at in range(0, TIMES.size, 3000):
                yield Rows({name: values[name][at : at + 3000] for name in names})
                if self.error is not None and at:
                    raise self.error

        clock = NativeClock(Fraction(RATE))
        return NativeFile((Stream("s", tuple(map(Column, values)), TIMES.size, clock, read),))


@pytest.fixture
def logger(know: Callable[[object], None]) -> Logger:
    adapter = Logger()
    know(adapter)
    return adapter


@pytest.fixture
def folder(logger: Logger, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the two files of a run, a database and a map, and one for temporary files."""
    monkeypatch.chdir(tmp_path)
    for name in ("more", "temporary"):
        (tmp_path / name).mkdir()
    for name in ("run.log", "more/run.log", "bus.dbc"):
        (tmp_path / name).write_text(name)
    (tmp_path / "map.toml").write_text(MAP)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    return tmp_path


def test_the_profile_is_that_of_the_recording_directory(folder: Path, ran) -> None:
    clock = UniformClock.of(RATE)
    channels = tuple(Channel.of(name, values, clock) for name, values in RUN.items())
    write_recording(Recording(channels, Setup(profile_interval_m=0.05)), folder / "rec")
    ran("process", "rec", "--out", "direct", "--pipeline", "temporal-basic")
    ran(*PROCESS, "--pipeline", "temporal-basic")
    direct, mapped = read_profile(folder / "direct"), read_profile(folder / "out")
    assert mapped.interval_m == 0.05
    np.testing.assert_array_equal(mapped.tracks[0].valid, direct.tracks[0].valid)
    np.testing.assert_allclose(
        mapped.tracks[0].elevation, direct.tracks[0].elevation, rtol=0, atol=1e-12
    )
    assert list((folder / "temporary").iterdir()) == []


def test_provenance_has_adapter_map_channels_and_the_sha256_of_every_file(
    folder: Path, ran
) -> None:
    ran(*PROCESS)
    provenance = read_profile(folder / "out").provenance
    assert (provenance["source"], provenance["adapter"]) == ("run.log", "logger")
    assert provenance["map"] == "map.toml"
    files = ("run.log", "more/run.log", "bus.dbc", "map.toml")
    assert provenance["sha256"] == {
        name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in files
    }
    assert provenance["channels"] == {
        "height": "s/laser",
        "distance": "s/dmi",
        "vertical_specific_force": "force: s/acc",
    }


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (RuntimeError("a\nb"), "Error: adapter logger: "),
        (SystemExit(0), "Error: adapter logger: "),
        (OSError(5, "Input/output error"), "run.log: Input/output error"),
        (MemoryError(), "not enough memory"),
    ],
)
def test_what_fails_while_streaming_is_one_line_and_leaves_nothing(
    folder: Path, logger: Logger, error: BaseException, message: str, refused
) -> None:
    logger.error = error
    assert message in refused(*PROCESS)
    assert not (folder / "out").exists()
    assert list((folder / "temporary").iterdir()) == []


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('unit = "g"', 'unit = "m/s^2"', "channel vertical_specific_force (force: s/acc): mean is"),
        ('unit = "mm"', 'unit = "m"', "channel height (s/laser): median is 300"),
        ("more/run.log", "more/gone.log", "gone.log: not found"),
        ('align = "offset"', "", "has no content; write align"),
        ("[source]", '[source]\nadapter = "mdf9"', "adapter mdf9: unknown"),
    ],
)
def test_a_map_that_does_not_fit_is_one_line_and_leaves_nothing(
    folder: Path, old: str, new: str, message: str, refused
) -> None:
    (folder / "map.toml").write_text(MAP.replace(old, new, 1))
    assert message in refused(*PROCESS)
    assert not (folder / "out").exists()
    assert list((folder / "temporary").iterdir()) == []


def test_a_recording_directory_needs_no_map(folder: Path, refused) -> None:
    clock = UniformClock.of(RATE)
    channels = tuple(Channel.of(name, values, clock) for name, values in RUN.items())
    write_recording(Recording(channels), folder / "rec")
    args = ["process", "rec", "--out", "out", "--map", "map.toml"]
    line = refused(*args)
    assert "adapter recording has our channels; it needs no map" in line
    named = MAP.replace("[source]", '[source]\nadapter = "logger"', 1)
    (folder / "map.toml").write_text(named)
    assert refused(*args) == line


def test_warnings_have_the_native_name(
    folder: Path, monkeypatch: pytest.MonkeyPatch, reported
) -> None:
    spoilt = NATIVE["laser"].copy()
    spoilt[4000:4010] = np.nan
    monkeypatch.setitem(NATIVE, "laser", spoilt)
    warnings = reported(*PROCESS)["warnings"]
    assert any(line.startswith("channel height (s/laser): 10 of 8000") for line in warnings)
