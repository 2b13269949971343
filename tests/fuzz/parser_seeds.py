"""Sound files of the parsers that have no fuzzer of their own, written by what writes them."""

import json
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
from parsers import BETWEEN, PARSERS

from floatref import Channel, Profile, ProfileTrack, Recording, StampedClock, UniformClock
from floatref.files import write_profile, write_profile_csv, write_recording

Seeds = Callable[[Path], Iterable[bytes]]


def make_seeds(name: str, folder: Path) -> list[bytes]:
    """Return the sound inputs of parser ``name``, written below ``folder``."""
    return [*SEEDS[name](folder)] if name in SEEDS else []


def _made_profile() -> Profile:
    heights = 0.01 * np.sin(np.arange(12) / 3.0)
    track = ProfileTrack.of("left", heights, heights > -0.009, np.full(12, 1e-4))
    return Profile(0.1, (track,), 5.0, "temporal-basic", {"cut_off_m": 100.0}, {"by": "a"})


def _profile_directory(folder: Path) -> Iterable[bytes]:
    write_profile(_made_profile(), folder / "seed")
    yield _pack("profile_directory", folder / "seed")


def _pack(name: str, folder: Path) -> bytes:
    files = PARSERS[name].files
    assert sorted(files) == sorted(path.name for path in folder.iterdir()), [*folder.iterdir()]
    return BETWEEN.join((folder / file).read_bytes() for file in files)


def _profile_csv(folder: Path) -> Iterable[bytes]:
    write_profile_csv(_made_profile(), folder / "seed.csv")
    yield (folder / "seed.csv").read_bytes()


def _written_by(name: str) -> Seeds:
    def make(folder: Path) -> Iterable[bytes]:
        from floatref.engine.plugins import plugins

        form = plugins().profile_formats()[name]
        form.write(_made_profile(), folder / f"seed{form.suffix}")
        yield (folder / f"seed{form.suffix}").read_bytes()

    return make


def _any_profile(folder: Path) -> Iterable[bytes]:
    yield from _profile_csv(folder)
    for name in ("text", "erd", "parquet"):
        yield from _written_by(name)(folder)


def _viewer_text(folder: Path) -> Iterable[bytes]:
    yield from _written_by("text")(folder)
    yield b"LElev - Distance (ft)\tLElev_Full (in)\tR - Distance (ft)\tR_Full (in)\r\n" + b"".join(
        b"%d\t0.%d\t%d\t0.5\r\n" % (k, k, k) for k in range(4)
    )
    yield b"L - Distance ft\tL_Full\r\n0\t1\r\n1\t2\r\n"


def _recording_directory(folder: Path) -> Iterable[bytes]:
    clock = StampedClock(np.arange(6) / 7.0)
    heights = Channel.of("height", np.full(12, 0.3), UniformClock.of(100.0), "left")
    distance = Channel.of("distance", np.arange(6.0), clock)
    write_recording(Recording((heights, distance)), folder / "seed")
    yield _pack("recording_directory", folder / "seed")


def _can_database(folder: Path) -> Iterable[bytes]:
    yield (
        b'VERSION ""\nBU_: ECU\nBO_ 291 Wheels: 8 ECU\n SG_ Speed m0 : 8|16@1+ (0.01,0) [0|655.35] '
        b'"km/h" ECU\n SG_ Kind M : 0|8@1+ (1,0) [0|1] "" ECU\n SG_ Turn : 39|16@0- (1,0) '
        b'[0|0] "deg/s" ECU\nVAL_ 291 Kind 0 "a" 1 "b" ;\n'
    )


def _batch_record(folder: Path) -> Iterable[bytes]:
    from floatref.batch.results.record import Record, write_record

    write_record(Record("a", "a.csv", warnings=("b",), key={"pipeline": "c"}), folder / "seed.json")
    yield (folder / "seed.json").read_bytes()


def _live_lines(folder: Path) -> Iterable[bytes]:
    yield _lines(
        _hello(),
        {"kind": "samples", "channels": {"left.height": {"values": [0.3, None], "first": 0}}},
        {"kind": "samples", "channels": {"distance": {"values": [0.0], "times_s": [0.5]}}},
        {"kind": "finish"},
    )


def _hello() -> dict[str, object]:
    channels = [
        {"name": "height", "track": "left", "unit": "m", "rate_hz": 100, "start_s": 0.5},
        {"name": "distance", "unit": "m"},
    ]
    setup = {"profile_interval_m": 0.1, "tracks": {"left": {"laser_offset_m": [0, 0, 1]}}}
    more = {"settings": {"cut_off_m": 100}, "late_s": 2, "points_from": 3, "setup": setup}
    head = {"kind": "hello", "format": "floatref-live/1", "token": "a"}
    return {**head, "channels": channels, **more}


def _lines(*documents: object) -> bytes:
    return b"".join(json.dumps(document).encode() + b"\n" for document in documents)


def _live_arrow(folder: Path) -> Iterable[bytes]:
    import pyarrow as pa

    from floatref.live.session.arrow_stream import HELLO, MESSAGES, schema_of

    hello = {key: value for key, value in _hello().items() if key != "token"}
    schema = schema_of(MESSAGES, {HELLO: json.dumps(hello).encode()})
    rows = [
        {"kind": "samples", "channel": "left.height", "first": 0, "values": [0.3, None]},
        {"kind": "samples", "channel": "distance", "values": [0.0], "times_s": [0.5]},
    ]
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, schema) as writer:
        for part in (rows, [{"kind": "finish"}]):
            writer.write_batch(pa.RecordBatch.from_pylist(part, schema))
    yield sink.getvalue().to_pybytes()


def _live_state(folder: Path) -> Iterable[bytes]:
    from floatref import Setup, start_stream

    channels = {"left.height": 100.0, "left.vertical_specific_force": 100.0, "distance": None}
    stream = start_stream(Setup(), channels, "temporal-basic")
    stream.save(folder / "seed.npz")
    yield (folder / "seed.npz").read_bytes()


def _scenario(folder: Path) -> Iterable[bytes]:
    from floatref_conformance.proving_ground.scenario import Scenario

    yield _lines(Scenario().to_dict())


def _case(folder: Path) -> Iterable[bytes]:
    from floatref_conformance.case_files import document
    from floatref_conformance.checks.case import Case
    from floatref_conformance.classes import DeviceClass
    from floatref_conformance.proving_ground.scenario import Scenario

    case = Case("quiescent", Scenario(speed_kmh=50.0), {"at_m": 3.0})
    yield _lines(document(case, DeviceClass.NOMINAL, "exec:./x", "too rough"))


def _practice(folder: Path) -> Iterable[bytes]:
    import floatref_conformance.certify.practice as room

    for path in sorted((Path(str(room.__file__)).parent / "data").glob("*e950-class-1.json")):
        yield path.read_bytes().replace(b'"astm-e950', b'"of-an-agency')


def _report(folder: Path) -> Iterable[bytes]:
    device = {"spec": "exec:./x", "name": "x", "version": "1"}
    check = {"id": "quiescent", "outcome": "skip", "reason": "not selected", "cases": 0} | {
        "class_reached": None, "worst": None, "shown": None, "clause": "R 56-14, 6"
    }  # fmt: skip
    yield _lines(
        {"format": "conformance-report/1", "edition": "2026.2", "class": "nominal", "seed": 0}
        | {"device": {**device, "architecture": "temporal", "capabilities": []}}
        | {"class_reached": None, "effort": "quick", "verdict": "INCOMPLETE", "replayed": []}
        | {"checks": [{**check, "flagged_m": 0.0, "counterexample": None}]}
    )


def _archive(folder: Path) -> Iterable[bytes]:
    from floatref_conformance.submission.stored_zip import write_archive

    members = {"SHA256SUMS": b"", "report.json": b"{}\n", "results/quiescent.json": b"[]\n"}
    write_archive(members, folder / "seed.zip")
    yield (folder / "seed.zip").read_bytes()


def _submission(folder: Path) -> Iterable[bytes]:
    from floatref_conformance.checks.verdict import CaseResult
    from floatref_conformance.submission.result_records import write_result

    device = {"spec": "exec:./x", "name": "x", "version": "1", "architecture": "temporal"}
    yield BETWEEN.join(
        (
            _lines(
                {"format": "conformance-submission/1", "edition": "2026.2", "seed": 0}
                | {"effort": "quick", "class": "nominal", "checks": ["quiescent"]}
                | {"device": {**device, "capabilities": [], "files": {"x": "0" * 64}}}
                | {"searching": True, "fault": "", "end_fault": "", "timeout_s": None}
                | {"waivers": [{"check": "quiescent", "reason": "a"}], "variables": []}
                | {"statement": "a", "environment": {"os": "b"}}
                | {"suite": {"version": "1", "sha256": "0" * 64}}
            ),
            _lines([write_result(CaseResult("a", {"scenario": {}, "variation": {}}))]),
        )
    )


def _device_answer(folder: Path) -> Iterable[bytes]:
    latency = {"travelled_m": 1, "then_s": 1, "longest_s": 9, "standing_s": 2}
    track = {"elevation": [0.1, None], "valid": [True, False], "sigma": [0.1, None]}
    points = {"state": "final", "first": 3, "interval_m": 0.1, "tracks": {"left": track}}
    yield _lines({"kind": "started", "format": "floatref-live/1", "latency": latency})
    yield _lines({"kind": "points", **points})
    yield _lines({"kind": "synced", "number": 7})


def _open_crg(folder: Path) -> Iterable[bytes]:
    import pycrg

    v = np.linspace(-1.2, 1.2, 5)
    heights = 0.01 * np.sin(np.arange(6))[:, None] + 0.001 * v
    pycrg.write(folder / "seed.crg", heights, 0.5, v, u0=100.0)
    yield (folder / "seed.crg").read_bytes()


def _constant(*seeds: bytes) -> Seeds:
    return lambda folder: seeds


SEEDS: dict[str, Seeds] = {
    "profile_directory": _profile_directory,
    "profile_csv": _profile_csv,
    "any_profile": _any_profile,
    "viewer_text": _viewer_text,
    "profile_parquet": _written_by("parquet"),
    "recording_directory": _recording_directory,
    "settings": _constant(b'{"cut_off_m": 100.0, "sigma_height_m": null}'),
    "can_database": _can_database,
    "manifest": _constant(b"file,pipeline\nrun.csv,temporal-basic\n", b"# a\nrun.csv\n"),
    "batch_record": _batch_record,
    "live_lines": _live_lines,
    "live_arrow": _live_arrow,
    "live_directory": _constant(b'{"format": "a", "provenance": {"live": {"windows": []}}}'),
    "live_state": _live_state,
    "token": _constant(b"a" * 40 + b"\n"),
    "scenario": _scenario,
    "case": _case,
    "waivers": _constant(b"quiescent  too rough # a\n"),
    "plan": _constant(
        b'format = "conformance-plan/1"\n[[sections]]\nname = "a"\nreference = "run.csv"\n'
        b'runs = ["run*.csv"]\nfrom_m = 10\nto_m = 160.9\n[quiescent]\nsource = "run.csv"\n'
        b"from_m = 1.0\nto_m = 2\n"
    ),
    "practice": _practice,
    "report": _report,
    "submission_archive": _archive,
    "submission": _submission,
    "device_answer": _device_answer,
    "recorded_device": _constant(b'{"name": "x", "version": "1", "architecture": "temporal"}'),
    "open_crg": _open_crg,
}
