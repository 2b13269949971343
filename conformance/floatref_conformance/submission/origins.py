"""Where a verdict comes from: hashes of the device and of the suite, and what they ran on."""

import os
import platform
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.files.fingerprint import sha256 as sha256_of
from floatref_conformance.devices.containers.container_device import ContainerDevice
from floatref_conformance.devices.executable import ExecDevice
from floatref_conformance.devices.interface import Device
from floatref_conformance.devices.python_device import HOST
from floatref_conformance.devices.recorded import PROFILE, RecordedDevice, cases

SDK, REFERENCE, SUITE = "floatref", "floatref_reference", "floatref_conformance"
DRAWER = "hypothesis"
"""What draws the cases of a search: another version may draw others from the same seed."""
MISSING = "missing"
"""The version of a package that is not installed."""
PACKAGES = ("numpy", "scipy", "numba", DRAWER)
FURTHER = "further"
COMPILED = frozenset({".pyc", ".nbi", ".nbc"})


def hash_device(device: Device, spec: str, files: Iterable[Path] = ()) -> dict[str, str]:
    """Return the SHA-256 of what makes ``device``, and of further ``files``, by name.

    Of a program these are the program and each file among its arguments; of a container its image;
    of a Python object all modules of its package; of `files:` the delivered profiles; of the others
    our own packages. A further file with the name of another has `FURTHER` before its own.
    Raises InputError for a file that cannot be read.
    """
    found = _hash_own(device, spec)
    for path in files:
        digest, name = sha256_of(path), path.name
        while found.get(name, digest) != digest:
            name = f"{FURTHER} {name}"
        found[name] = digest
    return found


def _hash_own(device: Device, spec: str) -> dict[str, str]:
    if isinstance(device, ExecDevice) and device.argv[: len(HOST)] == HOST:
        return _hash_package(device.argv[len(HOST)])
    if isinstance(device, ExecDevice):
        # Not `Path.is_file`: an argument may be too long to be a name.
        here = [word for word in device.argv if os.path.isfile(device.folder / word)]
        return {_name(word, here): sha256_of(device.folder / word) for word in here}
    if isinstance(device, ContainerDevice):
        return {device.image: device.digest}
    if isinstance(device, RecordedDevice):
        return {PROFILE: _join(_hash_case(case) for case in cases(device.folder))}
    packages = (SDK,) if spec.startswith("builtin:") else (SDK, SUITE)
    return {name: hash_package(name) for name in packages}


def _name(word: str, words: Sequence[str]) -> str:
    """Return the name of the file ``word``; all of ``word`` where another has the same name."""
    name = Path(word).name
    return name if sum(Path(each).name == name for each in words) == 1 else word


@cache
def hash_package(name: str) -> str:
    """Return the SHA-256 of all files of an installed package, compiled ones left out."""
    return _hash_folder(_folder_of(name))


def describe_suite() -> dict[str, str]:
    """Return version and SHA-256 of the suite, with the SDK and the reference that it uses."""
    digests = [hash_package(name) for name in (SDK, REFERENCE, SUITE)]
    return {"version": version("floatref"), "sha256": _join(digests)}


def describe_environment() -> dict[str, str]:
    """Return what rounding depends on: versions, system and the features of the processor."""
    features = np.show_config(mode="dicts").get("SIMD Extensions", {})
    return {
        "python": platform.python_version(),
        **{name: _version(name) for name in PACKAGES},
        "system": platform.system(),
        "machine": platform.machine(),
        "processor": ", ".join(map(str, features.get("found", []))) or "unknown",
    }


def describe_other_drawer(environment: Mapping[str, Any]) -> str:
    """Return with which other version a search drew the cases of an archive; empty if with ours.

    ``environment`` is what the archive states of its own. Every archive of a search states one.
    """
    stated, here = environment.get(DRAWER), _version(DRAWER)
    if stated in (None, MISSING, here):
        return ""
    return f"{DRAWER} {stated}, here it is {here}"


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return MISSING


def _folder_of(name: str) -> Path:
    found = find_spec(name)
    if found is None or not found.submodule_search_locations:
        raise InputError(f"package {name}: not found; install it")
    return Path(next(iter(found.submodule_search_locations)))


def _hash_package(factory: str) -> dict[str, str]:
    """Return the SHA-256 of the package of ``factory``, `package.module:factory`, by its name.

    The vendor's code is not run for it: the current folder is looked into, then the path.
    """
    top = factory.partition(":")[0].partition(".")[0]
    for path in (Path(top), Path(f"{top}.py")):
        if path.exists():
            return {top: _hash_folder(path) if path.is_dir() else sha256_of(path)}
    found = find_spec(top)
    if found is not None and found.submodule_search_locations:
        return {top: _hash_folder(Path(next(iter(found.submodule_search_locations))))}
    return {} if found is None or not found.has_location else {top: _of_origin(found)}


def _of_origin(found: Any) -> str:
    return sha256_of(Path(found.origin))


def _hash_folder(folder: Path) -> str:
    """Return one SHA-256 of the names and contents of all files below ``folder``."""
    paths = sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix not in COMPILED)
    return _join(f"{sha256_of(p)}  {p.relative_to(folder).as_posix()}" for p in paths)


def _hash_case(case: Path) -> str:
    paths: Mapping[str, str] = {p.name: sha256_of(p) for p in sorted(case.iterdir()) if p.is_file()}
    return _join([case.name, *(f"{digest}  {name}" for name, digest in paths.items())])


def _join(lines: Iterable[str]) -> str:
    return sha256("".join(f"{line}\n" for line in lines).encode()).hexdigest()
