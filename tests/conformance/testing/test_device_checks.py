"""The checks as a vendor's tests: a device that fails one fails its test, and says how."""

import shlex
import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import pytest

from floatref_conformance import EDITION
from floatref_conformance.plugins import load_registry
from floatref_conformance.testing import DeviceChecks, device_checks

SUITE = """
from floatref_conformance.devices.builtin import BuiltinDevice
from floatref_conformance.testing import DeviceChecks

class Broken(BuiltinDevice):
    def run(self, recording, profile):
        raise RuntimeError("no power")

def ours():
    return Broken("temporal-adaptive-hpf-spatial-backward")

class TestOurs(DeviceChecks):
    device = ours
    checks = ("bounce",)
"""


class Sound:
    """A built-in pipeline as a vendor's object that must not be used after it was closed."""

    made: tuple["Sound", ...] = ()

    def __init__(self):
        self.device = load_registry().device("builtin:temporal-adaptive-hpf-spatial-backward")
        self.closed = 0
        type(self).made += (self,)

    def describe(self):
        assert not self.closed
        return self.device.describe()

    def run(self, recording, profile):
        assert not self.closed
        return self.device.run(recording, profile)

    def close(self):
        self.closed += 1


class Declining(Sound):
    def run(self, recording, profile):
        return {"skipped": "out of ink"}


class Broken(Sound):
    def run(self, recording, profile):
        raise RuntimeError("no power")


def pytest_in(folder, *words):
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-o", "addopts="]
    return subprocess.run(
        [*command, *words], cwd=folder, capture_output=True, text=True, check=False
    )


@pytest.fixture
def judged(request):
    """Return a function that runs one check on a device."""

    def run(device, check="quiescent", **settings):
        cls = type("TestIt", (DeviceChecks,), {"device": device, **settings})
        cls().test_the_device_passes(check, request)

    return run


@pytest.mark.slow
def test_a_sound_device_passes(judged):
    judged(DeviceChecks.device, checks=("quiescent",))


@pytest.mark.slow
def test_a_wrong_device_fails_with_the_command_that_shows_it_again(judged):
    with pytest.raises(pytest.fail.Exception, match=r"quiescent: .*conformance run --device"):
        judged("mutant:scaled")


def test_what_is_not_selected_is_skipped_not_passed(judged):
    with pytest.raises(pytest.skip.Exception, match="not selected"):
        judged(DeviceChecks.device, checks=("bounce",))


@pytest.mark.slow
def test_a_check_that_there_is_none_of_is_told_in_one_line(tmp_path):
    text = SUITE.replace('("bounce",)', '("quiesent", "bounce", "bounc")')
    (tmp_path / "test_ours.py").write_text(text)
    done = pytest_in(tmp_path, "test_ours.py")
    assert done.returncode == 2
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("TestOurs.checks: ")]
    assert "unknown check quiesent, bounc; did you mean quiescent?" in line
    assert "Traceback" not in done.stdout


def test_a_check_that_is_not_in_a_tuple_is_refused():
    class Single(DeviceChecks):
        checks = "quiescent"

    function = SimpleNamespace(fixturenames=("check",))
    with pytest.raises(pytest.Collector.CollectError, match=r"write \('quiescent',\)"):
        Single().pytest_generate_tests(function)


def test_every_registered_check_is_a_test(monkeypatch):
    registry = load_registry()
    more = replace(registry, checks={**registry.checks, "ours:wet": registry.check("bounce")})
    monkeypatch.setattr(device_checks, "load_registry", lambda edition: more)
    asked = {}
    function = SimpleNamespace(fixturenames=("check", "request"), parametrize=asked.__setitem__)
    DeviceChecks().pytest_generate_tests(function)
    assert asked == {"check": (*registry.checks, "ours:wet")}


def test_the_checks_are_those_of_the_edition(monkeypatch):
    registry, editions = load_registry("2026.1"), []
    monkeypatch.setattr(device_checks, "load_registry", lambda e: editions.append(e) or registry)
    function = SimpleNamespace(fixturenames=("check",), parametrize=lambda *_: None)
    DeviceChecks().pytest_generate_tests(function)
    type("Older", (DeviceChecks,), {"edition": "2026.1"})().pytest_generate_tests(function)
    assert editions == [EDITION, "2026.1"]


@pytest.mark.slow
def test_the_command_names_an_edition_that_is_not_the_default(judged):
    with pytest.raises(pytest.fail.Exception, match=r"--edition 2026\.1 --check quiescent"):
        judged("mutant:scaled", edition="2026.1")
    with pytest.raises(pytest.fail.Exception) as failed:
        judged("mutant:scaled")
    assert "--edition" not in str(failed.value)


@pytest.mark.slow
def test_an_object_of_the_vendors_passes(judged):
    judged(Sound)


MAKERS = [Declining, staticmethod(lambda: Declining()), lambda: Declining()]


@pytest.mark.slow
@pytest.mark.parametrize("make", MAKERS, ids=["class", "static", "function"])
def test_each_check_has_an_object_of_its_own_that_is_closed_once(judged, make):
    before = len(Declining.made)
    for check in ("quiescent", "bounce"):
        with pytest.raises(pytest.skip.Exception, match="out of ink"):
            judged(make, check)
    assert [one.closed for one in Declining.made[before:]] == [1, 1]


@pytest.mark.slow
def test_one_object_for_all_checks_stays_open(judged):
    one = Declining()
    for check in ("quiescent", "bounce"):
        with pytest.raises(pytest.skip.Exception, match="out of ink"):
            judged(one, check)
    assert one.closed == 0


@pytest.mark.slow
@pytest.mark.parametrize("device", [Broken, Broken()], ids=["class", "object"])
def test_a_device_may_be_an_object(judged, device):
    with pytest.raises(pytest.fail.Exception, match="no power"):
        judged(device)


def test_a_factory_that_fails_is_the_devices_fault(judged):
    def make():
        raise RuntimeError("no licence")

    with pytest.raises(pytest.fail.Exception, match="no licence"):
        judged(make)


@pytest.mark.slow
def test_the_command_for_an_object_shows_the_failure_again(tmp_path):
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_ours.py").write_text(SUITE)
    done = pytest_in(tmp_path, "tests")
    assert "1 failed" in done.stdout
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("bounce: ")]
    program, *words = shlex.split(line.partition("reproduce with: ")[2])
    assert program == "pytest"
    again = pytest_in(tmp_path, *words)
    assert "1 failed" in again.stdout
    assert "no power" in again.stdout
