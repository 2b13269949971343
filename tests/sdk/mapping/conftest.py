"""A logger whose files hold what a test says, and a run that can be given to it."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest

from floatref.architectures import hookspecs, plugins, processing, readers
from floatref.errors import InputError
from floatref.mapping import read_map
from floatref.values.native import Column, NativeClock, NativeFile, Rows, Stream

Content = Callable[[Mapping[str, str]], NativeFile]


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
    """Return a stream of ``columns``, read in pieces of ``piece`` rows."""
    values = {key: np.asarray(column, np.float64) for key, column in columns.items()}
    stamps = None if ticks is None else np.asarray(ticks)
    size = len(next(iter(values.values())))

    def read(names: Sequence[str]) -> Iterator[Rows]:
        for at in range(0, size, piece):
            rows = slice(at, at + piece)
            part = None if stamps is None else stamps[rows]
            yield Rows({n: values[n][rows] for n in names}, part)

    named = tuple(Column(key, (units or {}).get(key, "")) for key in values)
    made = NativeClock(**clock)  # type: ignore[arg-type]
    return Stream(title, named, size if count is None else count, made, read)


@pytest.fixture
def logger(monkeypatch: pytest.MonkeyPatch) -> Logger:
    """The adapter, known to all commands."""
    adapter = Logger()

    class Plugin:
        @hookspecs.hookimpl
        def floatref_register_adapters(self, register: Callable[[object], None]) -> None:
            register(adapter)

    loaded = plugins.Plugins()
    loaded.add(Plugin(), "logger")
    for module in (readers, processing):
        monkeypatch.setattr(module, "plugins", lambda: loaded)
    return adapter


@pytest.fixture
def put(logger: Logger, tmp_path: Path) -> Callable[..., Path]:
    """Make a file of the logger that holds the given streams."""

    def make(*streams: Stream, name: str = "run.log", **more: object) -> Path:
        logger.content[name] = NativeFile(streams, **more)  # type: ignore[arg-type]
        (tmp_path / name).write_bytes(b"native")
        return tmp_path / name

    return make


def drive(seconds: float = 8.0, rate: int = 1000) -> dict[str, np.ndarray]:
    """Return the nominal channels of a run at 20 m/s in SI units."""
    times = np.arange(int(seconds * rate)) / rate
    return {
        "distance": 20.0 * times,
        "height": 0.3 + 0.005 * np.sin(15.0 * times),
        "vertical_specific_force": 9.80665 + 1e-3 * np.sin(15.0 * times),
    }


@pytest.fixture
def make_stream() -> Callable[..., Stream]:
    """Make a stream: its name, its columns, then what `stream` takes."""
    return stream


@pytest.fixture
def a_drive() -> Callable[..., dict[str, np.ndarray]]:
    """Make a run: seconds and rate."""
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


@pytest.fixture(scope="session")
def refusal() -> Callable[[Path], str]:
    """Tell why a map is refused, in one line, without its name in front."""

    def told(path: Path) -> str:
        with pytest.raises(InputError) as caught:
            read_map(path)
        line = str(caught.value)
        assert line.startswith(f"{path}: ")
        assert line.isprintable()
        return line.removeprefix(f"{path}: ")

    return told
