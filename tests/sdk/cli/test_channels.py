"""`floatref channels` as a user calls it."""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_recording
from floatref.values.clock import UniformClock
from floatref.values.native import Column, NativeClock, NativeFile, Rows, Stream
from floatref.values.recording import Channel, Recording

G = 9.80665
COUNT = 4000
UNITS = {"Acc_Z_left": "g", "Laser LWP": "mm", "DMI": "m", "Temp": "degC"}


def samples() -> dict[str, np.ndarray]:
    times = np.arange(COUNT) / 1000
    return {
        "Acc_Z_left": 1 + 1e-4 * np.sin(15 * times),
        "Laser LWP": 300 + 5 * np.sin(15 * times),
        "DMI": 20 * times,
        "Temp": np.full(COUNT, 20.0),
    }


class Logger:
    """The adapter of files `*.log`, of which all hold the same run."""

    name, summary = "logger", "one run"
    warnings = ("3 frames with a wrong checksum: dropped",)
    evil = ""

    def __init__(self) -> None:
        self.options: list[dict[str, str]] = []

    def recognises(self, source: Path) -> bool:
        return source.suffix == ".log"

    def streams(self, source: Path, options: dict[str, str]) -> NativeFile:
        self.options.append(dict(options))
        values = samples()

        def read(names: Sequence[str]) -> Iterator[Rows]:
            yield Rows({name: values[name] for name in names})

        columns = (
            *(Column(n, u) for n, u in UNITS.items()),
            Column(f"id{self.evil}", "", "hex", False),
        )
        clock = NativeClock(Fraction(1000))
        return NativeFile(
            (Stream("adc", columns, COUNT, clock, read),), self.warnings, "Acme", "P1"
        )


@pytest.fixture
def logger(know: Callable[[object], None]) -> Logger:
    adapter = Logger()
    know(adapter)
    return adapter


@pytest.fixture
def run(logger: Logger, tmp_path: Path) -> Path:
    (tmp_path / "run.log").write_bytes(b"native")
    return tmp_path / "run.log"


def test_every_column_is_listed_with_unit_rows_and_clock(run: Path, ran) -> None:
    result = ran("channels", run)
    lines = result.stdout.splitlines()
    assert lines[0] == f"{run} (logger)"
    for name, unit in UNITS.items():
        row = next(line for line in lines if name in line)
        assert row.split()[0] == "adc"
        assert unit in row
        assert "4000" in row
        assert "1000 Hz" in row
    assert lines[-1] == "1 streams, 4000 rows in all"
    assert result.stderr == "Warning: 3 frames with a wrong checksum: dropped\n"


def test_json_holds_the_same(run: Path, reported) -> None:
    report = reported("channels", run)
    assert report["adapter"] == "logger"
    assert report["device"] == {"vendor": "Acme", "model": "P1"}
    stream = report["streams"][0]
    assert (stream["name"], stream["count"], stream["rate_hz"]) == ("adc", COUNT, 1000.0)
    assert stream["columns"][0] == {"name": "Acc_Z_left", "unit": "g", "numeric": True, "note": ""}
    assert stream["columns"][-1] == {"name": "id", "unit": "", "numeric": False, "note": "hex"}
    assert report["warnings"] == ["3 frames with a wrong checksum: dropped"]


def test_a_drafted_map_can_be_given_back(run: Path, tmp_path: Path, invoke, reported) -> None:
    drafted = invoke("channels", run, "--draft-map")
    assert drafted.exit_code == 0, drafted.output
    assert drafted.stderr == "Warning: 3 frames with a wrong checksum: dropped\n"
    chart = tmp_path / "map.toml"
    chart.write_text(drafted.stdout, "utf-8")
    tried = reported("channels", run, "--map", chart)
    found = {c["channel"]: c for c in tried["channels"]}
    assert list(found) == ["left.vertical_specific_force", "left.height", "distance"]
    native = samples()
    force = found["left.vertical_specific_force"]
    assert force["mean"] == pytest.approx(G * native["Acc_Z_left"].mean(), rel=1e-12)
    assert found["left.height"]["least"] == pytest.approx(native["Laser LWP"].min() / 1e3)
    assert found["distance"]["greatest"] == pytest.approx(native["DMI"].max())
    assert all(c["count"] == COUNT and c["rate_hz"] == 1000 for c in tried["channels"])
    assert tried["warnings"] == ["run.log: 3 frames with a wrong checksum: dropped"]
    table = invoke("channels", run, "--map", chart)
    assert table.exit_code == 0
    assert "adc/Laser LWP" in table.stdout


def test_a_map_that_gives_nothing_to_process_is_a_warning_alone(
    run: Path, tmp_path: Path, ran
) -> None:
    chart = tmp_path / "map.toml"
    text = 'format = "floatref-map/1"\n[[channels]]\nnative = "DMI"\nchannel = "distance"\n'
    chart.write_text(text)
    result = ran("channels", run, "--map", chart)
    assert "Warning: cannot be processed yet: channel height: missing" in result.stderr


def test_a_database_is_passed_on_and_drafted(run: Path, logger: Logger, invoke) -> None:
    database = run.with_name("bus.dbc")
    database.write_bytes(b"")
    assert 'dbc = "bus.dbc"' in invoke("channels", run, "--draft-map", "--dbc", database).stdout
    assert logger.options == [{"dbc": str(database.resolve())}]


def test_a_recording_directory_is_listed_as_well(tmp_path: Path, ran, reported, refused) -> None:
    clock = UniformClock.of(1000.0)
    channels = (
        Channel.of("height", np.ones(5), clock, "left"),
        Channel.of("distance", np.arange(5.0), clock),
    )
    write_recording(Recording(channels), tmp_path / "run")
    result = ran("channels", tmp_path / "run")
    assert "left.height" in result.stdout
    assert "2 streams, 10 rows in all" in result.stdout
    report = reported("channels", tmp_path / "run")
    assert [s["columns"][0]["name"] for s in report["streams"]] == ["left.height", "distance"]
    assert "it needs no map" in refused("channels", tmp_path / "run", "--draft-map")


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["no.log"], "no.log: not found"),
        (["run.xyz"], "no adapter recognises it"),
        (["run.log", "--adapter", "logr"], "adapter logr: unknown"),
        (["run.log", "--map", "no.toml"], "no.toml: "),
        (["run.log", "--map", "bad.toml"], "bad.toml: not TOML: "),
        (["run.log", "--map", "lost.toml"], "'Lasr' is not in the file; did you mean"),
        (["run.log", "--map", "bad.toml", "--draft-map"], "--map takes no"),
        (["run.log", "--map", "bad.toml", "--dbc", "x.dbc"], "--map takes no"),
        (["run.log", "--colour"], "No such option"),
        ([], "Missing argument 'FILE'"),
    ],
)
def test_what_cannot_be_done_is_one_line(
    run: Path, monkeypatch: pytest.MonkeyPatch, args: list[str], message: str, refused
) -> None:
    monkeypatch.chdir(run.parent)
    Path("run.xyz").write_bytes(b"")
    Path("bad.toml").write_text("x = [")
    text = 'format = "floatref-map/1"\n[[channels]]\nnative = "Lasr"\nchannel = "height"\n'
    Path("lost.toml").write_text(text)
    assert message in refused("channels", *args)


def test_names_that_would_break_a_terminal_are_shown_as_text(
    run: Path, logger: Logger, ran, reported
) -> None:
    logger.evil = "\n\x1b[2J\udc80\u202e"
    logger.warnings = ("a\nb\x1b[2J",)
    for args in ([], ["--draft-map"]):
        result = ran("channels", run, *args)
        assert not {"\x1b", "\u202e", "\udc80"} & set(result.output)
        assert result.stderr == "Warning: a\\nb\\x1b[2J\n"
    assert reported("channels", run)["streams"][0]["columns"][-1]["name"] == (f"id{logger.evil}")
