"""A logger whose files hold what a test says, and a run that can be given to it."""

import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from floatref.errors import FloatrefError, InputError
from floatref.mapping import Reading, read_map, read_native
from floatref.mapping.channel_map.entries import ChannelEntry, ChannelMap, ClockEntry
from floatref.mapping.clocks.columns import Taken, Wanted, as_they_are, take
from floatref.mapping.spool import Spool
from floatref.values.native import Column, NativeClock, NativeFile, Rows, Stream


class Logger:
    """The adapter of files `*.log`, whose content a test has given by name."""

    name, summary = "logger", "what a test says"

    def __init__(self) -> None:
        self.content: dict[str, NativeFile | Exception] = {}
        self.options: Mapping[str, str] = {}

    def recognises(self, source: Path) -> bool:
        return source.suffix == ".log"

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        self.options = options
        found = self.content[source.name]
        if isinstance(found, Exception):
            raise found
        return found


def stream(
    title: str,
    columns: Mapping[str, Sequence[float]],
    units: Mapping[str, str] | None = None,
    ticks: Sequence[float] | None = None,
    piece: int = 1000,
    count: int | None = None,
    **clock: object,
) -> Stream:
    values = {key: np.asarray(column, np.float64) for key, column in columns.items()}
    stamps = None if ticks is None else np.asarray(ticks)
    size = len(next(iter(values.values())))

    def read(names: Sequence[str]) -> Iterator[Rows]:
        for at in range(0, size, piece):
            rows = slice(at, at + piece)
            part = None if stamps is None else stamps[rows]
            yield Rows({n: values[n][rows] for n in names}, part)

    named = tuple(Column(key, (units or {}).get(key, "")) for key in values)
    made = NativeClock(**clock)  # type: ignore[arg-type]  # Of any field.
    return Stream(title, named, size if count is None else count, made, read)


@pytest.fixture(scope="session")
def reading() -> Callable[..., Stream]:
    """Make a stream whose column "row" counts its rows, which are read in pieces between cuts."""

    def make(
        ticks: np.ndarray | None, cuts: Sequence[int] = (), count: int | None = None, **clock: Any
    ) -> Stream:
        size = len(ticks) if ticks is not None else clock.pop("size")
        rows = np.arange(size, dtype=np.float64)

        def read(names: Sequence[str]) -> Iterator[Rows]:
            for part in np.split(np.arange(size), sorted(cuts)):
                yield Rows(dict.fromkeys(names, rows[part]), None if ticks is None else ticks[part])

        made = NativeClock(**clock)
        return Stream("s", (Column("row"),), size if count is None else count, made, read)

    return make


@pytest.fixture(scope="session")
def taken() -> Callable[..., Taken]:
    """Take the column "row" of a stream, as often as is said, by a stated clock if there is one."""

    def of(stream: Stream, *stated: ClockEntry, columns: int = 1) -> Taken:
        with Spool() as spool:
            return take(stream, [Wanted("row", as_they_are)] * columns, spool, *stated)

    return of


@pytest.fixture(scope="session")
def times() -> Callable[[Taken], np.ndarray]:
    """Tell when every row was taken, in s after the zero of the epoch."""

    def of(found: Taken) -> np.ndarray:
        start, size = float(found.start_s), found.columns[0].size
        if found.rate is not None:
            return start + np.arange(size) / float(found.rate)
        assert found.times_s is not None
        assert found.times_s.size == size
        return start + found.times_s

    return of


@pytest.fixture
def logger(know: Callable[[object], None]) -> Logger:
    adapter = Logger()
    know(adapter)
    return adapter


@pytest.fixture
def put(logger: Logger, tmp_path: Path) -> Callable[..., Path]:
    """Make a file of the logger that holds the given streams."""

    def make(*streams: Stream, name: str = "run.log", **more: object) -> Path:
        logger.content[name] = NativeFile(streams, **more)  # type: ignore[arg-type]  # Any field.
        (tmp_path / name).write_bytes(b"native")
        return tmp_path / name

    return make


@pytest.fixture
def make_stream() -> Callable[..., Stream]:
    """Make a stream: its name, its columns, then what `stream` takes."""
    return stream


@pytest.fixture
def adc(make_stream: Callable[..., Stream]) -> Callable[..., Stream]:
    """Make a minute of an accelerometer at 500 Hz, which is the time base.

    ``columns`` are further ones, each a function of the time.
    """

    def make(columns: Mapping[str, Callable[[Any], Any]] | None = None, **more: Any) -> Stream:
        t = np.arange(30_000) / 500
        values = {"force": 9.8 + 0.1 * np.sin(t)}
        values |= {name: of(t) for name, of in (columns or {}).items()}
        return make_stream("adc", values, rate=Fraction(500), **more)

    return make


@pytest.fixture
def pulsed() -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """Make a voltage at some times: 5 V for 50 ms from each of others on, noise on it."""

    def of(times: np.ndarray, at: np.ndarray) -> np.ndarray:
        since = times - at[np.clip(np.searchsorted(at, times, "right") - 1, 0, None)]
        noise = np.random.default_rng(3).normal(size=times.size)
        return 5.0 * ((since >= 0) & (since < 0.05)) + 0.02 * noise

    return of


@pytest.fixture
def read(put: Callable[..., Path], tmp_path: Path) -> Callable[..., Reading]:
    """Read files of streams by a map without its first line."""

    def of(chart: str, *streams: Stream, **others: Stream) -> Reading:
        for name, stream in others.items():
            put(stream, name=f"{name}.log")
        (tmp_path / "map.toml").write_text('format = "floatref-map/1"\n' + chart)
        return read_native(put(*streams), tmp_path / "map.toml")

    return of


@pytest.fixture
def a_drive() -> Callable[..., dict[str, np.ndarray]]:
    """Make the nominal channels of a run at 20 m/s in SI units: seconds and rate."""

    def drive(seconds: float = 8.0, rate: int = 1000) -> dict[str, np.ndarray]:
        times = np.arange(int(seconds * rate)) / rate
        return {
            "distance": 20.0 * times,
            "height": 0.3 + 0.005 * np.sin(15.0 * times),
            "vertical_specific_force": 9.80665 + 1e-3 * np.sin(15.0 * times),
        }

    return drive


@pytest.fixture
def save(tmp_path: Path) -> Callable[[str | bytes], Path]:
    """Write a map into a folder of its own."""
    folder = tmp_path / "maps"
    folder.mkdir()

    def write(content: str | bytes) -> Path:
        path = folder / "map.toml"
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder in which temporary files are kept."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


@pytest.fixture
def nothing_left(temporary: Path) -> Iterator[None]:
    """See that no folder of samples stays behind, whatever happens."""
    yield
    assert list(temporary.iterdir()) == []


@pytest.fixture(scope="session")
def chart() -> Callable[..., ChannelMap]:
    """Make a map, of a laser in mm unless channels are given."""
    height = ChannelEntry("laser", "height", unit="mm")
    return lambda *channels, **more: ChannelMap(channels or (height,), **more)


@pytest.fixture(scope="session")
def refused() -> Callable[..., str]:
    """Tell in which one line of which kind `read_native` refuses what it is given."""

    def of(kind: type[FloatrefError], *args: object) -> str:
        with pytest.raises(FloatrefError) as caught:
            read_native(*args)  # type: ignore[arg-type]  # Wrong ones as well.
        assert isinstance(caught.value, kind)
        assert str(caught.value).isprintable()
        return str(caught.value)

    return of


@pytest.fixture(scope="session")
def refusal() -> Callable[[Path], str]:
    """Tell why a map is refused, in one line, without its name in front."""

    def of(path: Path) -> str:
        with pytest.raises(InputError) as caught:
            read_map(path)
        line = str(caught.value)
        assert line.startswith(f"{path}: ")
        assert line.isprintable()
        return line.removeprefix(f"{path}: ")

    return of
