"""Adapters touch no private name of a library: a minor version of it may change them."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import floatref_adapters

PACKAGE = Path(floatref_adapters.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))
OWN = {"self", "cls"}
ALLOWED = {"os._exit": "public, by the documentation of Python"}


def is_private(name: str) -> bool:
    return name.startswith("_") and not name.endswith("__")


def private_names(tree: ast.AST) -> Iterator[str]:
    """Yield private names that are taken of anything but the object itself."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and is_private(node.attr):
            own = isinstance(node.value, ast.Name) and node.value.id in OWN
            if not own and ast.unparse(node) not in ALLOWED:
                yield ast.unparse(node)
        elif isinstance(node, ast.ImportFrom):
            parts = [*(node.module or "").split("."), *(alias.name for alias in node.names)]
            yield from filter(is_private, parts)
        elif isinstance(node, ast.Import):
            names = [part for alias in node.names for part in alias.name.split(".")]
            yield from filter(is_private, names)
        elif isinstance(node, ast.Call) and ast.unparse(node.func) in {"getattr", "setattr"}:
            asked = [a.value for a in node.args[1:2] if isinstance(a, ast.Constant)]
            yield from (name for name in asked if is_private(str(name)))


def overridden(tree: ast.AST) -> Iterator[str]:
    """Yield the private methods of classes that have a base of a library."""
    imported = {
        alias.asname or alias.name.partition(".")[0]
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
        and not str(getattr(node, "module", "")).startswith("floatref")
        for alias in node.names
    }
    for node in ast.walk(tree):
        if not isinstance(node, ast.ClassDef):
            continue
        if {ast.unparse(base).partition(".")[0] for base in node.bases} & imported:
            yield from (
                f"{node.name}.{each.name}"
                for each in node.body
                if isinstance(each, ast.FunctionDef) and is_private(each.name)
            )


@pytest.mark.slow
@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.relative_to(PACKAGE).as_posix())
def test_no_private_name_of_a_library_is_touched(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert [*private_names(tree), *overridden(tree)] == []


@pytest.mark.parametrize(
    "code",
    [
        "mdf._mdf._load_data(group)",
        "segments = tdms._reader",
        "from nptdms._impl import x",
        "import pyarrow._parquet",
        "from pyarrow import _csv",
        "getattr(reader, '_segments')",
        "from nptdms import TdmsFile\nclass A(TdmsFile):\n    def _read_file(self): ...",
    ],
)
def test_a_private_name_is_found(code: str) -> None:
    tree = ast.parse(code)
    assert [*private_names(tree), *overridden(tree)]


@pytest.mark.parametrize("code", ["self._file.close()", "cls._kept", "a.__class__", "a.b"])
def test_an_own_name_is_left_alone(code: str) -> None:
    assert not [*private_names(ast.parse(code))]
