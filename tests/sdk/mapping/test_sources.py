"""Which adapter reads a source, and what happens when one fails."""

import re

import pytest
from click.testing import CliRunner

from floatref.cli.main import main
from floatref.files import read_profile, read_recording, write_recording
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup


@pytest.fixture
def folder(tmp_path, a_drive):
    """A folder with the recording directory ``run``: 8 s at 20 m/s, one wheel path."""
    clock = UniformClock.of(1000.0)
    channels = tuple(Channel.of(name, x, clock) for name, x in a_drive().items())
    write_recording(Recording(channels, Setup(profile_interval_m=0.05)), tmp_path / "run")
    return tmp_path


def invoke(*args):
    return CliRunner().invoke(main, [str(a) for a in args])


class Vendor:
    name, summary = "vendor", "of a plug-in"

    def __init__(self, recognises=True, recording=None):
        self._recognises, self._recording = recognises, recording

    def recognises(self, source):
        if isinstance(self._recognises, Exception):
            raise self._recognises
        return self._recognises

    def read(self, source):
        if isinstance(self._recording, Exception):
            raise self._recording
        return self._recording


def test_a_native_folder_is_read_by_its_adapter_and_fingerprinted(folder, know):
    recording = read_recording(folder / "run")
    know(Vendor(recording=recording))
    native = folder / "native"
    native.mkdir()
    (native / "run.bin").write_bytes(b"abc")
    result = invoke("process", native, "--out", folder / "o")
    assert result.exit_code == 0, result.output
    provenance = read_profile(folder / "o").provenance
    assert provenance["adapter"] == "vendor"
    assert list(provenance["sha256"]) == ["run.bin"]


@pytest.mark.parametrize(
    ("adapter", "message"),
    [
        (Vendor(), "adapters recording and vendor both recognise it; choose with --adapter"),
        (Vendor(False, None), None),
        (Vendor(ValueError("odd"), None), "Warning: adapter vendor: "),
    ],
)
def test_who_recognises_a_source(folder, know, adapter, message):
    know(adapter)
    result = invoke("process", folder / "run", "--out", folder / "o")
    assert result.exit_code == (2 if message and "both" in message else 0)
    assert message is None or message in result.stderr


@pytest.mark.parametrize(
    ("given", "message"),
    [(KeyError("x"), "adapter vendor: .*: KeyError: 'x'"), (None, "gave no recording")],
)
def test_an_adapter_that_fails_is_named(folder, know, given, message):
    know(Vendor(False, given))
    result = invoke("process", folder / "run", "--out", folder / "o", "--adapter", "vendor")
    assert result.exit_code == 2
    assert re.search(message, result.stderr)
    assert not (folder / "o").exists()
