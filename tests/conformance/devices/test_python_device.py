"""Devices that are Python objects of a vendor, in a process of their own."""

import sys

import pytest

from floatref.errors import InputError
from floatref_conformance.devices import python_device
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError, DeviceSkipped
from floatref_conformance.judge.exercise import close, describe, exercise

VENDOR = """\
import os, shutil, sys
print("imported")

class Vendor:
    def describe(self):
        print("describing")
        os.system("echo from a child")
        return {"name": "vendor", "version": "2", "architecture": "spatial", "capabilities": ()}

    def run(self, recording, profile):
        print("running", recording.name)
        sys.stdin.read()
        shutil.copytree(SOUND, profile)
"""


@pytest.fixture
def vendor(sound, tmp_path, monkeypatch):
    """Return a function that writes package `vendor_package.module` and makes its device."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    made = []

    def make(more="", factory="Vendor"):
        package = tmp_path / "vendor_package"
        package.mkdir(exist_ok=True)
        (package / "__init__.py").touch()
        (package / "module.py").write_text(f"{VENDOR}\nSOUND = {str(sound)!r}\n{more}")
        made.append(python_device.make(f"vendor_package.module:{factory}"))
        return made[-1]

    yield make
    for one in made:
        close(one)


@pytest.mark.slow
def test_an_object_is_run_in_another_process_and_may_print(vendor, recording):
    device = vendor()
    description = describe(device)
    assert description == Description("vendor", "2", "spatial", ())
    for _ in range(2):
        assert {t.name for t in exercise(device, description, recording).tracks} == {
            "left",
            "right",
        }
    assert close(device) == ""
    assert "vendor_package" not in sys.modules


@pytest.mark.posix
@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("raise ValueError('no\\\\nspeed')", "^run: answered an error: ValueError: no speed"),
        ("sys.exit('enough')", "run: answered an error: SystemExit: enough"),
        ("raise KeyboardInterrupt", "run: answered an error: KeyboardInterrupt"),
        ("os._exit(4)", "run: exited with status 4 before it answered"),
        ("os.abort()", "run: was killed by SIGABRT before it answered"),
        ("os.write(1, b'{}\\\\n'); os.write(2, b'aside\\\\n'); os._exit(1)", r"status 1 .*aside"),
    ],
)
def test_what_it_raises_is_an_error_and_what_kills_it_a_fault(vendor, recording, body, words):
    more = "import resource; resource.setrlimit(resource.RLIMIT_CORE, (0, 0))\n"
    more += f"def run(self, recording, profile): exec('''{body}''')\nVendor.run = run"
    device = vendor(more)
    with pytest.raises(DeviceError, match=words):
        exercise(device, describe(device), recording)


@pytest.mark.parametrize(
    "body",
    [
        "return {'skipped': 'too short'}",
        "from floatref_conformance.errors import DeviceSkipped; raise DeviceSkipped('too short')",
    ],
)
def test_it_may_skip_a_recording(vendor, recording, body):
    device = vendor(f"def run(self, recording, profile):\n    {body}\nVendor.run = run")
    with pytest.raises(DeviceSkipped, match=r"^too short$"):
        exercise(device, describe(device), recording)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("more", "words"),
    [
        (
            "def made(): raise OSError('no licence')",
            "start: answered an error: OSError: no licence",
        ),
        ("def made(): return object()", "start: answered an error: AttributeError: .*describe"),
        ("Vendor.describe = lambda self: None\nmade = Vendor", "start: .*TypeError"),
        (
            "Vendor.describe = lambda self: {'name': float('nan')}\nmade = Vendor",
            "start: .*ValueErr",
        ),
        ("Vendor.describe = lambda self: {'name': self}\nmade = Vendor", "start: .*TypeError"),
        ("made = Vendor\nimport no_such_module", "start: .*ModuleNotFoundError.*no_such_module"),
        ("made = Vendor\nraise RuntimeError('half')", "start: .*RuntimeError: half"),
        ("made = Vendor\nos._exit(6)", "start: exited with status 6"),
    ],
)
def test_an_object_that_cannot_be_made_is_a_fault_of_start(vendor, more, words):
    device = vendor(more, "made")
    with pytest.raises(DeviceError, match=words):
        describe(device)


@pytest.mark.slow
def test_it_is_closed_at_the_end_if_it_can_be(vendor, tmp_path):
    device = vendor("Vendor.close = lambda self: open('closed', 'w').close()")
    describe(device)
    assert close(device) == ""
    assert (tmp_path / "closed").exists()
    device = vendor("def close(self): raise OSError('stuck')\nVendor.close = close")
    describe(device)
    assert close(device).startswith("stop: exited with status 1 ; stderr: ")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("spec", "words"),
    [
        ("no_such_package.module:made", "no module no_such_package in the current folder"),
        ("vendor_package.absent:made", r"no module vendor_package\.absent in"),
        ("vendor_package.module:made", r"module vendor_package\.module has no made"),
        ("vendor_package.module:SOUND", r"SOUND of vendor_package\.module is a str, not a fun"),
        ("vendor_package", "not of the form package.module:factory"),
        ("vendor_package:", "not of the form"),
        (":made", "not of the form"),
        ("vendor package:made", "not of the form"),
        ("../vendor_package:made", "not of the form"),
    ],
)
def test_what_does_not_exist_is_wrong_usage(vendor, spec, words):
    vendor()
    with pytest.raises(InputError, match=f"^device python:.*{words}"):
        python_device.make(spec)


@pytest.mark.slow
def test_an_import_that_hangs_or_floods_is_left_to_the_start(vendor, monkeypatch):
    monkeypatch.setattr(python_device, "START_S", 0.5)
    device = vendor("import time; time.sleep(3600)")
    device.start_s = 0.2
    with pytest.raises(DeviceError, match=r"start: no answer within 0\.2 s"):
        describe(device)
