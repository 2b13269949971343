"""Files are read through one door, `floatref.files.sources`, or stand in a list with the reason.

Law: no other module of the packages opens a file for reading. What is given to a library that
opens files itself has passed `check_file` in the same expression, or the module is in the list.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROOMS = ("sdk/floatref", "adapters/floatref_adapters", "conformance/floatref_conformance")
DOOR = "sdk/floatref/files/sources.py"
READERS = {"read_text", "read_bytes", "read_schema"}
"""Methods of paths, and of pyarrow, that read; functions of ours have these names too."""
LIBRARIES = {
    "File",
    "FileIO",
    "MDF",
    "ParquetFile",
    "TdmsFile",
    "ZipFile",
    "cdll",
    "fromfile",
    "genfromtxt",
    "load_file",
    "loadtxt",
    "memmap",
    "memory_map",
    "mmap",
    "open_file",
    "open_memmap",
    "read_csv",
    "read_feather",
    "read_parquet",
    "read_table",
}
"""Functions of libraries that open what they are given."""
ALLOWED = {
    "sdk/floatref/files/mapped/mapped_files.py:memmap": "maps what the door has opened",
    "sdk/floatref/files/mapped/cut_files.py:mmap": "mmap(2), of no file",
    "sdk/floatref/files/apart/served_reading.py:read_text": "/proc/self/statm",
    "sdk/floatref/files/schema.py:read_text": "a file of the package",
    "sdk/floatref/c/amalgamation.py:read_text": "files of the package",
    "sdk/floatref/viewer/page_writer.py:read_text": "files of the package",
    "sdk/floatref/live/monitor/page_server.py:read_text": "files of the package",
    "sdk/floatref/cli/lazy.py:open": "a descriptor of a standard stream",
    "sdk/floatref/files/growing_profile.py:open": "a descriptor that is opened to append",
    "sdk/floatref/live/saved_state.py:load": "an opened stream",
    "sdk/floatref/live/session/peers.py:open": "the descriptor of standard input",
    "sdk/floatref/live/session/run_lock.py:open": "the descriptor of a directory that is locked",
    "sdk/floatref/batch/work/task.py:read_text": "/proc/self/status",
    "adapters/floatref_adapters/formats/mcap_log/mcap_reading.py:memmap": "a temporary file",
    "adapters/floatref_adapters/formats/tdms/group_rows.py:open": "npTDMS on an opened stream",
    "adapters/floatref_adapters/formats/mdf4/mdf_opening.py:MDF": "asammdf on an opened stream",
    "adapters/floatref_adapters/formats/mdf4/mdf_writing.py:MDF": "asammdf with no file",
    "adapters/floatref_adapters/testing/hdf5.py:File": "a new file",
    "adapters/floatref_adapters/formats/mdf4/mdf_opening.py:open": "the copy that it has made",
    "adapters/floatref_adapters/formats/can_log/can_database.py:load_file": "checked before it",
    "conformance/floatref_conformance/proving_ground/roads/crg.py:open": "checked before it",
    "conformance/floatref_conformance/devices/descendants.py:read_bytes": "files of /proc",
    "conformance/floatref_conformance/devices/streams/resident_memory.py:read_bytes": "of /proc",
    "conformance/floatref_conformance/editions/edition.py:read_text": "a file of the package",
    "conformance/floatref_conformance/golden/__init__.py:read_text": "a file of the package",
    "conformance/floatref_conformance/golden/__init__.py:read_bytes": "a file of the package",
    "conformance/floatref_conformance/schemas/__init__.py:read_text": "a file of the package",
    "conformance/floatref_conformance/proving_ground/roads/measured.py:read_text": "of the package",
    "conformance/floatref_conformance/proving_ground/cache.py:read_bytes": "files of the package",
    "conformance/floatref_conformance/proving_ground/drives/runs.py:read_text": "of the package",
    "conformance/floatref_conformance/table/published.py:read_text": "a file of the package",
    "conformance/floatref_conformance/submission/stored_zip.py:ZipFile": "on what the door opened",
    "sdk/floatref/files/owners.py:read_text": "what the system tells in /proc",
    "sdk/floatref/files/owners.py:read_bytes": "what the system tells in /proc",
    "conformance/floatref_conformance/mutants/flaws.py:read_text": "a file of the package",
    "conformance/floatref_conformance/resemblance/catalogue.py:read_text": "a file of the package",
    "conformance/floatref_conformance/certify/practice/practice_document.py:read_bytes": "its own",
    "conformance/floatref_conformance/samples/network.py:read_bytes": "what it has just written",
}
"""Where another opening is right, and why."""


def openings(code: str) -> Iterator[str]:
    """Yield the name of every call in ``code`` that opens something to read it."""
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if _opens(node, name) and not _is_checked(node):
                yield name


def _opens(call: ast.Call, name: str) -> bool:
    plain = isinstance(call.func, ast.Name)
    if name in READERS:
        return not plain
    if name == "load":
        return ast.unparse(call.func).startswith(("np.", "numpy."))
    if name == "open":
        return not _writes(call) and not _is_stage(call)
    return name in LIBRARIES


def _writes(call: ast.Call) -> bool:
    """Return whether ``call`` opens a file that it makes new, or the flags of `os.open`."""
    texts = [a.value for a in call.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]
    texts += [k.value.value for k in call.keywords if isinstance(k.value, ast.Constant)]
    return any(isinstance(text, str) and text[:1] in "wx" and text for text in texts)


def _is_stage(call: ast.Call) -> bool:
    """Return whether the `open` is that of a stage or a page, or `os.open` of the null device."""
    text = ast.unparse(call)
    return any(
        part in text for part in ("header", "os.devnull", "page.open(title)", "os.O_RDWR", "FLAGS")
    )


def _is_checked(call: ast.Call) -> bool:
    first = call.args[0] if call.args else None
    return isinstance(first, ast.Call) and getattr(first.func, "id", "") == "check_file"


def found() -> set[str]:
    """Return where a file is opened beside the door, as ``module:call``."""
    modules = {
        p.relative_to(ROOT).as_posix(): p for room in ROOMS for p in (ROOT / room).rglob("*.py")
    }
    modules.pop(DOOR)
    return {
        f"{name}:{call}"
        for name, path in modules.items()
        for call in openings(path.read_text(encoding="utf-8"))
    }


def test_files_are_opened_through_the_door() -> None:
    assert found() == set(ALLOWED)


@pytest.mark.parametrize(
    "code",
    [
        "open(path)",
        "open(path, 'rb')",
        "path.open('rb')",
        "path.open(encoding='utf-8')",
        "os.open(path, os.O_RDONLY)",
        "io.FileIO(path)",
        "path.read_text(encoding='utf-8')",
        "(folder / 'a').read_bytes()",
        "np.load(path)",
        "np.memmap(path)",
        "h5py.File(path)",
        "parquet.ParquetFile(str(path))",
    ],
)
def test_another_opening_is_found(code: str) -> None:
    assert list(openings(code))


@pytest.mark.parametrize(
    "code",
    [
        "open_bytes(path)",
        "read_bytes(path, 10, 'list')",
        "path.open('wb')",
        "path.open('w', encoding='utf-8')",
        "h5py.File(check_file(path), 'r')",
        "stage.open(header)",
    ],
)
def test_the_door_and_new_files_are_no_other_opening(code: str) -> None:
    assert not list(openings(code))
