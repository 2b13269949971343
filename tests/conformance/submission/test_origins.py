"""The hash of a device is that of what makes it: it changes with each byte, and with no place."""

import sys

import pytest

from floatref.errors import InputError
from floatref_conformance.devices import executable, python_device, recorded
from floatref_conformance.devices.builtin import make as make_builtin
from floatref_conformance.devices.containers.container_device import ContainerDevice
from floatref_conformance.devices.containers.engine import Engine
from floatref_conformance.submission.origins import (
    describe_environment,
    describe_suite,
    hash_device,
    hash_package,
)


def hash_of(spec, *files):
    kind, _, argument = spec.partition(":")
    make = {"exec": executable, "python": python_device, "files": recorded}[kind].make
    return hash_device(make(argument), spec, files)


def test_a_program_is_its_file_and_the_files_among_its_arguments(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "device.py").write_text("1")
    (tmp_path / "settings").write_text("2")
    before = hash_of(f"exec:{sys.executable} device.py --with settings")
    assert {"device.py", "settings"} < before.keys()
    (tmp_path / "settings").write_text("3")
    after = hash_of(f"exec:{sys.executable} device.py --with settings")
    assert {name for name in before if before[name] != after[name]} == {"settings"}


@pytest.mark.slow
def test_a_package_is_all_of_its_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    (tmp_path / "vendor" / "deep").mkdir(parents=True)
    (tmp_path / "vendor" / "__init__.py").write_text("def device(): ...")
    (tmp_path / "vendor" / "deep" / "table.csv").write_text("1")
    before = hash_of("python:vendor:device")
    (tmp_path / "vendor" / "cached.pyc").write_text("1")
    assert hash_of("python:vendor:device") == before
    (tmp_path / "vendor" / "deep" / "table.csv").write_text("2")
    assert hash_of("python:vendor:device") != before


def test_delivered_files_are_theirs(tmp_path):
    (tmp_path / "case").mkdir()
    (tmp_path / "case" / "recording.json").write_text("{}")
    before = hash_of(f"files:{tmp_path}")
    (tmp_path / "case" / "profile.json").write_text("{}")
    assert hash_of(f"files:{tmp_path}") != before


def test_a_further_file_replaces_neither_the_device_nor_another(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for folder in (".", "a", "b"):
        (tmp_path / folder).mkdir(exist_ok=True)
        (tmp_path / folder / "device.py").write_text(folder)
    spec = f"exec:{sys.executable} device.py"
    alone, further = hash_of(spec), [tmp_path / "a/device.py", tmp_path / "b/device.py"]
    found = hash_of(spec, *further, tmp_path / "device.py")
    assert found.items() > alone.items()
    assert set(found) - set(alone) == {"further device.py", "further further device.py"}
    assert len(set(found.values())) == len(found)
    image = ContainerDevice("device.py", "5e" * 32, Engine("podman"))
    assert hash_device(image, "container:device.py", further[:1])["device.py"] == "5e" * 32


@pytest.mark.slow
def test_further_files_count_and_a_missing_one_is_named(tmp_path):
    device = make_builtin("temporal-basic")
    (tmp_path / "library.so").write_text("1")
    assert set(hash_device(device, "builtin:x", [tmp_path / "library.so"])) == {
        "floatref",
        "library.so",
    }
    with pytest.raises(InputError, match="missing"):
        hash_device(device, "builtin:x", [tmp_path / "missing"])


def test_the_suite_is_more_than_the_sdk():
    assert hash_package("floatref") not in describe_suite().values()
    assert all(describe_environment().values())
