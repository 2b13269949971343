"""What each package may import, what is refused, and what is not loaded until it is needed."""

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
OURS = {"floatref", "floatref_adapters", "floatref_conformance", "floatref_reference"}
ALLOWED = {
    "sdk": {"click", "jsonschema", "numba", "numpy", "pluggy", "rich", "scipy"},
    "sdk/floatref/plots": {"matplotlib"},
    # Names of types alone, for type checkers.
    "sdk/floatref/values": {"matplotlib", "pandas", "xarray"},
    "sdk/floatref/batch": {"cryptography", "dask", "distributed", "pyarrow"},
    "sdk/floatref/live/session": {"pyarrow"},
    "sdk/floatref/files/gis": {"pyogrio", "shapely"},
    "adapters": {"numpy"},
    "adapters/floatref_adapters": {
        "asammdf",
        "can",
        "cantools",
        "h5py",
        "novatel_edie",
        "nptdms",
        "numexpr",
        "pandas",
        "pyarrow",
        "pynmea2",
        "xarray",
        # asammdf brings them along.
        "isal",
        "lz4",
        "zstd",
    },
    "reference_impl": {"numpy"},
    "conformance": {
        "click",
        "hypothesis",
        "jsonschema",
        "numba",
        "numpy",
        "platformdirs",
        "pluggy",
        "rich",
        "scipy",
    },
    "conformance/floatref_conformance/proving_ground/roads": {"pycrg"},
    "conformance/floatref_conformance/render": {"jinja2"},
    "conformance/floatref_conformance/table": {"matplotlib"},
    "conformance/floatref_conformance/testing": {"pytest"},
}
"""Distributions that a folder may use beside those of the folder around it."""


def imported(path: Path) -> Iterator[str]:
    """Yield the top name of every absolute import in ``path``."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            yield node.module.partition(".")[0]


@pytest.mark.slow
@pytest.mark.parametrize("room", ["sdk", "adapters", "reference_impl", "conformance"])
def test_a_package_imports_what_it_may(room: str) -> None:
    for path in (ROOT / room).rglob("*.py"):
        name = path.relative_to(ROOT).as_posix()
        allowed = OURS | set(sys.stdlib_module_names)
        allowed |= set().union(*(v for k, v in ALLOWED.items() if name.startswith(f"{k}/")))
        assert set(imported(path)) <= allowed, name


@pytest.mark.parametrize(
    "statement",
    [
        "import sdk.floatref",
        "from adapters.floatref_adapters import stamps",
        "from reference_impl import floatref_reference",
        "import conformance.floatref_conformance.cli",
    ],
)
def test_an_import_through_a_top_folder_is_refused(statement: str) -> None:
    command = [sys.executable, "-m", "ruff", "check", "--no-cache", "--select", "TID251"]
    found = subprocess.run(
        [*command, "--stdin-filename", "tests/test_any.py", "-"],
        input=f"{statement}\n",
        capture_output=True,
        text=True,
    )
    assert "TID251" in found.stdout


HEAVY = ("numba", "scipy.signal", "matplotlib", "jsonschema", "rich", "dask", "distributed")
REPORT = "import sys; print(*(m for m in {heavy!r} if m in sys.modules))"


@pytest.mark.slow
@pytest.mark.parametrize(
    "statement",
    [
        "import floatref",
        "import floatref, floatref.files, floatref.values.recording",
        "import floatref; floatref.Recording, floatref.Profile, floatref.InputError",
        "import floatref; floatref.AdaptiveHighPass(16000.0), floatref.HeightReflection()",
        "import floatref_adapters.plugin",
        "from floatref.cli.main import main; main(['--help'], standalone_mode=False)",
        "from floatref_conformance.cli.main import main; main(['--help'], standalone_mode=False)",
    ],
)
def test_a_light_import_loads_nothing_heavy(statement: str) -> None:
    code = f"{statement}\n{REPORT.format(heavy=HEAVY)}"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.splitlines()[-1].split() == []


def test_every_public_name_is_there() -> None:
    import floatref

    for name in floatref.__all__:
        assert getattr(floatref, name) is not None
    assert set(floatref.__all__) <= set(dir(floatref))
