"""Every way to spoil a recording gives one clear line that names what to change."""

import json
import os
import re
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.files import fingerprint, read_recording

Edit = Callable[[Path, Callable[[Any], Any]], None]
Change = Callable[[Any], Any]


def vehicle(document: Any) -> Any:
    """Return the vehicle that is put into ``document``."""
    stated = {"model": "quarter-car", "x_m": 1.7, "parameters": {"sprung_kg": 700.0}}
    return document["setup"].setdefault("vehicle", stated)


DOCUMENTS: list[tuple[str, Change, str]] = [
    ("unknown format", lambda d: d.update(format="floatref-recording/2"),
     r'format is "floatref-recording/2"; expected "floatref-recording/1"'),
    ("no format", lambda d: d.pop("format"), "has no format; expected an object with format"),
    ("no channels", lambda d: d.pop("channels"), "has no channels"),
    ("empty channels", lambda d: d.update(channels=[]), "a list of 0; expected a list of 1 to 256"),
    ("a million channels", lambda d: d.update(channels=[0] * 10**6), "a list of 1000000; expected"),
    ("channels of a wrong type", lambda d: d.update(channels={"a": 1}), r'channels is {"a": 1}'),
    ("unknown channel", lambda d: d["channels"][1].update(name="hight"),
     r'channels\[1\].name \(left.hight\) is "hight"; did you mean height\?'),
    ("far-off channel", lambda d: d["channels"][1].update(name="zzz"), "known: vertical_specific"),
    ("given twice", lambda d: d["channels"].append(d["channels"][1]), "left.height: given twice"),
    ("unit", lambda d: d["channels"][1].update(unit="mm"),
     "left.height: unit 'mm', expected 'm'; convert the samples, multiply them by 0.001"),
    ("unit in g", lambda d: d["channels"][0].update(unit="g"), r"'m/s\^2'; .*9.80665"),
    ("strange unit", lambda d: d["channels"][2].update(unit="furlong"), "unit 'furlong', expected"),
    ("no unit", lambda d: d["channels"][1].pop("unit"), r"\(left.height\) has no unit"),
    ("rate zero", lambda d: d["channels"][1].update(rate_hz=0),
     r"rate_hz \(left.height\) is 0; expected the sampling rate in Hz, a number between"),
    ("rate negative", lambda d: d["channels"][1].update(rate_hz=-16000), "is -16000; expected"),
    ("rate absurd", lambda d: d["channels"][1].update(rate_hz=1e12), "is 1000000000000.0; expect"),
    ("rate tiny", lambda d: d["channels"][1].update(rate_hz=1e-300), "is 1e-300; expected"),
    ("rate a string", lambda d: d["channels"][1].update(rate_hz="16000"), 'is "16000"; expected'),
    ("rate true", lambda d: d["channels"][1].update(rate_hz=True), "is true; expected"),
    ("start absurd", lambda d: d["channels"][1].update(start_s=1.7e18), "time of the first sample"),
    ("no clock", lambda d: d["channels"][3].pop("time_file"), "has no key of rate_hz, start_s"),
    ("no start", lambda d: d["channels"][1].pop("start_s"), "has rate_hz of rate_hz, start_s"),
    ("two clocks", lambda d: d["channels"][1].update(time_file="t.f64"),
     "has rate_hz and start_s and time_file of"),
    ("absolute path", lambda d: d["channels"][1].update(file="/etc/passwd"),
     'file .* is "/etc/passwd"; expected the plain name of a file beside recording.json'),
    ("path upward", lambda d: d["channels"][1].update(file="../x.f64"), '"../x.f64"; expected'),
    ("parent", lambda d: d["channels"][1].update(file=".."), r'file .* is "\.\."; expected'),
    ("time path upward", lambda d: d["channels"][3].update(time_file="../t"), "time_file .* plain"),
    ("null byte", lambda d: d["channels"][1].update(file="a\x00b"), r'is "a\\u0000b"; expected'),
    ("half a surrogate", lambda d: d["channels"][1].update(file="\ud800"), "plain name of a file"),
    ("trailing newline", lambda d: d["channels"][1].update(file="a\n"), r'is "a\\n"; expected'),
    ("long name", lambda d: d["channels"][1].update(file="a" * 5000), r'"a{56}\.\.\.; expected'),
    ("one file for two", lambda d: d["channels"][1].update(file=d["channels"][0]["file"]),
     "listed for vertical_specific_force and for height; give each quantity its own"),
    ("missing file", lambda d: d["channels"][1].update(file="other.f64"),
     "channel left.height: .*other.f64: No such file or directory; check the name"),
    ("track with a folder", lambda d: d["channels"][1].update(track="a/b"), "name of a wheel path"),
    ("track a number", lambda d: d["channels"][1].update(track=5), "track .* is 5; expected"),
    ("tiny interval", lambda d: d["setup"].update(profile_interval_m=1e-30),
     "setup.profile_interval_m is 1e-30; expected the profile interval in m, between"),
    ("setup a list", lambda d: d.update(setup=[]), "setup is a list|setup is \\[\\]"),
    ("offset in mm", lambda d: d["setup"].update(gnss_antenna_offset_m=[0, 0, 2000]),
     r"setup.gnss_antenna_offset_m\[2\] is 2000; expected an offset in m, within 100 m"),
    ("offset of two", lambda d: d["setup"].update(gnss_antenna_offset_m=[0, 0]), "three numbers"),
    ("offset of a track", lambda d: d["setup"]["tracks"]["left"].update(laser_offset_m="x"),
     'setup.tracks.left.laser_offset_m is "x"; expected three numbers in m'),
    ("setup of no track", lambda d: d["setup"]["tracks"].update({"a/b": {}}),
     'setup.tracks holds the name "a/b"; expected the name of a wheel path'),
    ("many tracks", lambda d: d["setup"].update(tracks={str(k): {} for k in range(65)}),
     "at most 64 wheel paths"),
    ("vehicle a name", lambda d: d["setup"].update(vehicle="truck"),
     'setup.vehicle is "truck"; expected an object with model, parameters and optionally x_m'),
    ("vehicle without a model", lambda d: vehicle(d).pop("model"), "setup.vehicle has no model"),
    ("vehicle without parameters", lambda d: vehicle(d).pop("parameters"), "has no parameters"),
    ("model empty", lambda d: vehicle(d).update(model=""), 'model is ""; expected the name'),
    ("wheel too far", lambda d: vehicle(d).update(x_m=1720),
     "setup.vehicle.x_m is 1720; expected the model's own point .* in m, within 100 m"),
    ("parameter a text", lambda d: vehicle(d)["parameters"].update(sprung_kg="700 kg"),
     'setup.vehicle.parameters.sprung_kg is "700 kg"; expected a number'),
    ("parameter missing", lambda d: vehicle(d)["parameters"].update(sprung_kg=None),
     "setup.vehicle.parameters.sprung_kg is null; expected a number"),
    ("parameter true", lambda d: vehicle(d)["parameters"].update(sprung_kg=True), "is true; ex"),
    ("axles without a place", lambda d: d["setup"].update(axles={"wheelbase_m": 3}),
     "setup.axles has no front_axle_m"),
    ("wheelbase in mm", lambda d: d["setup"].update(axles={"wheelbase_m": 3430, "front_axle_m": 0}),
     "setup.axles.wheelbase_m is 3430; expected the distance between the axles in m, between 0.5"),
    ("vendor a number", lambda d: d["device"].update(vendor=3), "device.vendor is 3; expected"),
]  # fmt: skip

TEXTS: list[tuple[str, bytes, str]] = [
    ("empty", b"", "empty; copy the complete file"),
    ("blank", b" \n\t", "empty; copy the complete file"),
    ("text", b"hello", r"not JSON at line 1, column 1 \(Expecting value\); correct it there"),
    ("cut short", b'{"format": "floatref-recording/1", "channels": [{"na', "file is cut short"),
    ("cut after a comma", b'{"format": 1,', "the file is cut short, copy it again"),
    ("binary", bytes(range(256)), "byte 128 is not UTF-8 text; give the JSON file"),
    ("float64", np.full(9, 9.8).tobytes(), "is not UTF-8 text; give the JSON file"),
    ("NaN", b'{"start": NaN}', "holds NaN, which is not JSON; write null"),
    ("Infinity", b'{"start": -Infinity}', "holds -Infinity, which is not JSON"),
    ("1e400", b'{"start": 1e400}', "holds the number 1e400; float64 ends at 1.8e308"),
    ("many digits", b'{"start": ' + b"9" * 10**5 + b"}", r"holds the number 9+\.\.; float64 ends"),
    ("nested", b"[" * 10**5, "nested too deeply"),
    ("huge", b" " * (5 << 20), "larger than 4 MiB; keep samples in files of their own"),
    ("a list", b"[1, 2]", r"is \[1, 2\]; expected an object"),
    ("a word", b"null", "is null; expected an object"),
]

FILES: list[tuple[str, Callable[[Path], Any], str]] = [
    ("empty", lambda p: p.write_bytes(b""), "empty; copy the complete file"),
    ("cut within a sample", lambda p: os.truncate(p, 8 * 2000 - 3),
     "15997 bytes are not a whole number of float64 samples; the file is truncated"),
    ("infinite", lambda p: np.array([0.3, -np.inf]).tofile(p),
     "left.height: sample 1 is infinite; mark missing samples as NaN"),
    ("a folder", lambda p: (p.unlink(), p.mkdir()), "is a folder; a file is expected here"),
    ("a pipe", lambda p: (p.unlink(), os.mkfifo(p)), "is a device or pipe; a file is expected"),
    ("a device", lambda p: (p.unlink(), p.symlink_to("/dev/zero")), "is a device or pipe"),
    ("a loop of links", lambda p: (p.unlink(), p.symlink_to(p)), "oo many .*symbolic links"),
    ("removed", lambda p: p.unlink(), "No such file or directory; check the name"),
]  # fmt: skip


def refusal(call: Callable[[Path], object], path: Path) -> str:
    """Return the line of the refusal, after checking that it is one line."""
    with pytest.raises(InputError) as caught:
        call(path)
    line = str(caught.value)
    assert "\n" not in line
    assert len(line) < 600
    return line


@pytest.mark.slow
@pytest.mark.parametrize(("change", "text"), [case[1:] for case in DOCUMENTS],
                         ids=[case[0] for case in DOCUMENTS])  # fmt: skip
def test_a_spoilt_document_is_named(folder: Path, edit: Edit, change: Change, text: str) -> None:
    document = folder / "recording.json"
    edit(document, change)
    line = refusal(read_recording, folder)
    assert re.search(text, line)
    assert str(folder) in line


@pytest.mark.parametrize(("content", "text"), [case[1:] for case in TEXTS],
                         ids=[case[0] for case in TEXTS])  # fmt: skip
def test_a_file_that_is_no_such_json_is_named(folder: Path, content: bytes, text: str) -> None:
    document = folder / "recording.json"
    document.write_bytes(content)
    for call in (read_recording, fingerprint):
        line = refusal(call, folder)
        assert line.startswith(f"{document}: ")
        assert re.search(text, line)


@pytest.mark.posix
@pytest.mark.parametrize(("spoil", "text"), [case[1:] for case in FILES],
                         ids=[case[0] for case in FILES])  # fmt: skip
def test_a_spoilt_sample_file_is_named(
    folder: Path, spoil: Callable[[Path], Any], text: str
) -> None:
    samples = folder / "left.height.f64"
    spoil(samples)
    line = refusal(read_recording, folder)
    assert re.search(text, line)
    assert str(samples) in line
    assert "left.height" in line


@pytest.mark.parametrize(
    ("times", "text"),
    [
        ([5.0, 5.0, 6.0], "time stamp 1 is 5 s, not after 5 s; times must increase"),
        ([5.0, 7.0, 6.0], "time stamp 2 is 6 s, not after 7 s; times must increase"),
        ([5.0, np.nan, 6.0], "time stamp 1 is nan; every sample needs a time"),
        ([5.0, 6.0], "gnss_height: 3 samples but 2 time stamps"),
    ],
)
def test_spoilt_times_are_named(folder: Path, times: list[float], text: str) -> None:
    np.array(times).tofile(folder / "gnss_height.time.f64")
    line = refusal(read_recording, folder)
    assert text in line
    assert "gnss_height" in line


def test_a_directory_without_its_document_is_named(folder: Path) -> None:
    (folder / "recording.json").unlink()
    line = refusal(read_recording, folder)
    assert f"{folder}/recording.json: No such file or directory" in line
    assert "No such file" in refusal(read_recording, folder / "nowhere")
    (folder / "recording.json").mkdir()
    assert "is a folder; a file is expected here" in refusal(read_recording, folder)


def test_a_path_that_is_no_path_is_named(folder: Path) -> None:
    for name in ("a\x00b", "\ud800"):
        assert f"{name!a}: no possible file name" in refusal(read_recording, Path(name))


@pytest.mark.posix
@pytest.mark.parametrize("name", ["recording.json", "left.height.f64"])
def test_a_file_that_may_not_be_read_is_named(
    folder: Path, name: str, unprivileged: Callable[[], AbstractContextManager[None]]
) -> None:
    (folder / name).chmod(0)
    with unprivileged():
        line = refusal(read_recording, folder)
    assert f"{folder / name}: Permission denied; ask for the right to read it" in line


def test_of_repeated_keys_the_last_one_counts(folder: Path) -> None:
    document = folder / "recording.json"
    text = document.read_text().rstrip().removesuffix("}")
    document.write_text(text + ', "device": {"vendor": "first"}, "device": {"vendor": "last"}}')
    assert read_recording(folder).vendor == "last"
    assert json.loads(document.read_text())["device"]["vendor"] == "last"
