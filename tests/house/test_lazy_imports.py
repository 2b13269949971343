"""What is not imported until it is needed: compilers, filters, tables and figures."""

import subprocess
import sys

import pytest

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
