"""The import contracts: each catches the import that it is there to forbid."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROOMS = ("sdk", "adapters", "reference_impl", "conformance")
BREACHES = {
    "sdk/floatref/values/arrays.py": "floatref.files",
    "sdk/floatref/values/clock.py": "floatref.kernels",
    "sdk/floatref/values/display/views.py": "floatref.plots",
    "sdk/floatref/kernels/motion.py": "floatref.stages",
    "sdk/floatref/stages/marks.py": "floatref.measures",
    "sdk/floatref/measures/gaps.py": "floatref.files",
    "sdk/floatref/files/samples.py": "floatref.kernels",
    "sdk/floatref/interfaces/adapter.py": "floatref.intake",
    "sdk/floatref/screening/travel.py": "floatref.intake",
    "sdk/floatref/intake/aligned.py": "floatref.vehicle_response",
    "sdk/floatref/estimators/smoothing/lag.py": "floatref.builtin_pipelines",
    "sdk/floatref/builtin_pipelines/basic_steps.py": "floatref.engine.flow",
    "sdk/floatref/retrofit/alone.py": "floatref.engine.flow",
    "sdk/floatref/engine/flow.py": "floatref_conformance",
    "sdk/floatref/engine/collecting.py": "floatref.cli",
    "sdk/floatref/live/points.py": "floatref.mapping.reading",
    "sdk/floatref/errors.py": "floatref_reference",
    "sdk/floatref/plots/figure.py": "floatref_adapters",
    "sdk/floatref/plots/sensitivity.py": "floatref.tuning.levels",
    "sdk/floatref/tuning/levels.py": "floatref.cli.printing",
    "sdk/floatref/notebook/tables.py": "floatref.batch",
    "adapters/floatref_adapters/shared/stated_clock.py": "floatref.values.clock",
    "reference_impl/floatref_reference/signals.py": "scipy",
    "reference_impl/floatref_reference/appendix_a/filters.py": "floatref.values.arrays",
    "conformance/floatref_conformance/judge/judging.py": "floatref_reference",
    "conformance/floatref_conformance/checks/stretches.py": "floatref.stages.filters.butterworth",
    "conformance/floatref_conformance/judge/runner.py": "floatref.engine.run",
    "conformance/floatref_conformance/judge/exercise.py": "floatref",
}
"""One forbidden import per wall: the file that is given it, and what it imports."""


def lint_imports(tree: Path) -> str:
    """Return what the import contracts say of ``tree``."""
    path = os.pathsep.join(str(tree / room) for room in ROOMS)
    command = "import sys; from importlinter.cli import lint_imports_command as lint; lint()"
    found = subprocess.run(
        [sys.executable, "-c", command, "--no-cache"],
        cwd=tree,
        env={**os.environ, "PYTHONPATH": path, "COLUMNS": "200"},
        capture_output=True,
        text=True,
    )
    return found.stdout + found.stderr


@pytest.fixture(scope="module")
def said(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Return what the contracts say of a copy of the tree with every breach in it."""
    tree = tmp_path_factory.mktemp("tree")
    for room in ROOMS:
        shutil.copytree(ROOT / room, tree / room, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tree)
    for file, target in BREACHES.items():
        assert (tree / file).is_file(), file
        with (tree / file).open("a", encoding="utf-8") as stream:
            stream.write(f"\nimport {target}\n")
    return lint_imports(tree)


def test_every_breach_is_planted_in_a_file_that_is_there() -> None:
    assert [file for file in BREACHES if not (ROOT / file).is_file()] == []


@pytest.mark.slow
@pytest.mark.parametrize("file", BREACHES)
def test_a_forbidden_import_is_caught(said: str, file: str) -> None:
    importer = file.partition("/")[2].removesuffix(".py").replace("/", ".")
    assert f"{importer} -> {BREACHES[file]} " in said


@pytest.mark.slow
def test_every_contract_is_broken_by_some_breach(said: str) -> None:
    assert "Contracts: 0 kept" in said
