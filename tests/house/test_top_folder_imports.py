"""Imports through the top folders, which would load a module twice, are refused by the linter."""

import subprocess
import sys

import pytest


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
