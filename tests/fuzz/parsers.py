"""Every parser that has no fuzzer of its own: what reads a file, and the files it reads.

An input is the file that is given to the parser or, for one of several files in a folder, these
files in the order of `Parser.files`, with `BETWEEN` between them.
"""

import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

BETWEEN = b"\xff\n--\n\xff"
Read = Callable[[Path], object]
NATIVE = {
    "parquet": ".parquet",
    "arrow": ".arrow",
    "hdf5": ".h5",
    "mdf4": ".mf4",
    "tdms": ".tdms",
    "nmea": ".nmea",
    "novatel": ".gps",
    "can": ".asc",
    "mcap": ".mcap",
}
"""The adapters that `fuzz_native` fuzzes, and a suffix of each."""


@dataclass(frozen=True)
class Parser:
    """One parser.

    Attributes:
        load: imports it, and returns what reads a path: the first of the files, or their folder.
        files: their names; of a single file the suffix is part of what is tested.
        beside: further files that it may name, which stay as they are.
    """

    load: Callable[[], Read]
    files: tuple[str, ...]
    folder: bool = False
    beside: Mapping[str, bytes] | None = None

    def write(self, data: bytes, folder: Path) -> Path:
        """Write the files of ``data`` to ``folder``; return the path that the parser is given."""
        parts = data.split(BETWEEN) if len(self.files) > 1 else [data]
        for name, content in zip(self.files, parts, strict=False):
            (folder / name).write_bytes(content)
        for name in self.files[len(parts) :]:
            (folder / name).write_bytes(b"")
        for name, content in (self.beside or {}).items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)
        return folder if self.folder else folder / self.files[0]


def _named(module: str, function: str) -> Callable[[], Read]:
    def load() -> Read:
        read: Read = getattr(import_module(module), function)
        return read

    return load


def _profile_format(name: str) -> Callable[[], Read]:
    def load() -> Read:
        from floatref.engine.plugins import plugins

        form: Any = plugins().profile_formats()[name]

        def read(path: Path) -> object:
            form.recognises(path)
            if hasattr(form, "read_unstated"):
                form.read_unstated(path)
            return form.read(path)

        return read

    return load


def _settings() -> Read:
    from floatref.engine.automatic import resolve_named_or_best
    from floatref.files.settings_file import read_settings

    return lambda path: resolve_named_or_best("road-prior-smoother", read_settings(path))


def _can_database() -> Read:
    from floatref.engine.plugins import plugins

    can = plugins().adapters()["can"]

    def read(path: Path) -> object:
        with can.streams(path.with_name("run.log"), {"dbc": str(path)}) as native:
            return [[*s.read([c.name for c in s.columns if c.numeric])] for s in native.streams]

    return read


def _manifest() -> Read:
    from floatref.batch.jobs.defaults import Defaults
    from floatref.batch.jobs.manifest import is_manifest, read_manifest

    return lambda path: (is_manifest(path), read_manifest(path, Defaults()))


def _live_messages() -> Read:
    from floatref.live.session.encodings import Reading

    return lambda path: [*Reading(io.BufferedReader(io.BytesIO(path.read_bytes()))).messages()]


def _waivers() -> Read:
    from floatref_conformance.judge.waivers import read_waivers

    return lambda path: read_waivers(path, {"quiescent": None})


def _practice() -> Read:
    from floatref_conformance.certify.practice.practice_document import find_practice

    return lambda path: find_practice(str(path))


def _report() -> Read:
    from floatref_conformance.matrix.stored_reports import read_reports

    return lambda path: read_reports([path])


def _submission() -> Read:
    from floatref_conformance.submission.document import NAME, read_submission
    from floatref_conformance.submission.verifying import read_results

    def read(folder: Path) -> object:
        content = (folder / NAME).read_bytes()
        results = read_results({"results/quiescent.json": (folder / "results.json").read_bytes()})
        submission = read_submission(content)
        return submission.about, submission.describe(), results

    return read


def _device_answer() -> Read:
    from floatref import InputError
    from floatref_conformance.devices.protocol import parse_line
    from floatref_conformance.devices.streams import answers
    from floatref_conformance.errors import DeviceError

    by_kind: dict[str, Callable[[Mapping[str, Any]], object]] = {
        "started": answers.read_started,
        "points": answers.read_points,
    }

    def read(path: Path) -> object:
        try:
            answer = parse_line(path.read_bytes())
            return by_kind.get(answers.kind_of(answer), answers.read_number)(answer)
        except DeviceError as error:
            raise InputError(str(error)) from error

    return read


def _recorded_device() -> Read:
    from floatref import InputError
    from floatref_conformance.devices.interface import Description
    from floatref_conformance.devices.recorded import make
    from floatref_conformance.errors import DeviceError

    def read(folder: Path) -> object:
        try:
            return Description.of(make(str(folder)).describe())
        except DeviceError as error:
            raise InputError(str(error)) from error

    return read


def _open_crg() -> Read:
    from floatref_conformance.proving_ground.roads.crg import crg_road

    return lambda path: crg_road(path, 10.0)


CAN_LOG = b"".join(b"(%d.000100) can0 123#0001020304050607\n" % k for k in range(4))
PARSERS = {
    "profile_directory": Parser(
        _named("floatref.files", "read_profile"),
        ("profile.json", "left.f64", "left.valid.u8", "left.sigma.f64"),
        True,
    ),
    "profile_csv": Parser(_named("floatref.files", "read_profile"), ("run.csv",)),
    "any_profile": Parser(_named("floatref.engine.formats", "profile_of"), ("run",)),
    "viewer_text": Parser(_profile_format("text"), ("run.txt",)),
    "profile_parquet": Parser(_profile_format("parquet"), ("run.parquet",)),
    "recording_directory": Parser(
        _named("floatref.files", "read_recording"),
        ("recording.json", "left.height.f64", "distance.f64", "distance.time.f64"),
        True,
    ),
    "settings": Parser(_settings, ("settings.json",)),
    "can_database": Parser(_can_database, ("run.dbc",), beside={"run.log": CAN_LOG}),
    "manifest": Parser(_manifest, ("list.csv",), beside={"run.csv": b"distance_m\n"}),
    "batch_record": Parser(
        _named("floatref.batch.results.record", "read_record"), ("record.json",)
    ),
    "live_lines": Parser(_live_messages, ("messages",)),
    "live_arrow": Parser(_live_messages, ("messages",)),
    "live_directory": Parser(
        _named("floatref.live.session.run_directory", "is_complete"), ("profile.json",), True
    ),
    "live_state": Parser(_named("floatref.live.saved_state", "load_state"), ("stream.npz",)),
    "token": Parser(_named("floatref.live.session.connections", "read_token"), ("token",)),
    "scenario": Parser(
        _named("floatref_conformance.proving_ground.scenario_file", "read_scenario"),
        ("scenario.json",),
    ),
    "case": Parser(_named("floatref_conformance.case_files", "read_case"), ("case.json",)),
    "waivers": Parser(_waivers, ("waivers",)),
    "plan": Parser(
        _named("floatref_conformance.certify.plan.plan_document", "read_plan"),
        ("plan.toml",),
        beside={"run.csv": b"distance_m\n"},
    ),
    "practice": Parser(_practice, ("practice.json",)),
    "report": Parser(_report, ("report.json",)),
    "submission_archive": Parser(
        _named("floatref_conformance.submission.stored_zip", "read_archive"), ("submission.zip",)
    ),
    "submission": Parser(_submission, ("submission.json", "results.json"), True),
    "device_answer": Parser(_device_answer, ("answer",)),
    "recorded_device": Parser(
        _recorded_device, ("device.json",), True, {"case/recording.json": b""}
    ),
    "open_crg": Parser(_open_crg, ("road.crg",)),
}
