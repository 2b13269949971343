"""The README: its commands are the ones that CI runs, and its example runs."""

import re
import shlex
import subprocess
from pathlib import Path

import click
import numpy as np
import pytest

import floatref
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.cli.main import main as conformance
from floatref_conformance.devices.builtin import RECOMMENDED
from floatref_conformance.plugins import load_registry

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
COMMANDS = re.findall(r"^```sh\n(.+)\n```$", README, re.M)
EXAMPLE = re.findall(r"^```python\n(.*?)^```$", README, re.M | re.S)


def test_there_are_two_commands_and_one_example_on_one_page() -> None:
    assert len(COMMANDS) == 2
    assert len(EXAMPLE) == 1
    assert len(README.splitlines()) <= 70


def test_the_first_command_runs_every_check_on_what_is_recommended() -> None:
    words = shlex.split(COMMANDS[0])
    asked = words[words.index(".venv/bin/conformance") + 1 :]
    run = conformance.get_command(click.Context(conformance), asked[0])
    assert run is not None
    context = run.make_context("run", asked[1:])
    assert context.params["ids"] == ()
    assert context.params["spec"] == f"builtin:{RECOMMENDED}"


def test_the_readme_counts_the_checks() -> None:
    assert set(load_registry().checks) == set(IDS)
    assert len(IDS) == 15
    assert "Fifteen checks" in README


@pytest.mark.posix
def test_ci_runs_the_second_command() -> None:
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    (extraction,) = re.findall(r"^tests=\$\((.+)\)$", script, re.M)
    found = subprocess.run(
        ["bash", "-c", extraction], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert found.stdout.strip() == COMMANDS[1]
    assert 'bash -c "$tests"' in script
    assert '"$bin/pytest" -m "slow and not nightly"' in script


def test_the_example_writes_a_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    time = np.arange(16_000) / 16_000
    force = 9.80665 + 0.4 * np.sin(20.0 * time)
    height = 0.3 - 0.001 * np.sin(20.0 * time)
    np.save(tmp_path / "run.npy", np.stack((force, height, 20.0 * time)))
    monkeypatch.chdir(tmp_path)
    exec(EXAMPLE[0], {})
    profile = floatref.read_profile(tmp_path / "profile")
    assert profile.length_m == pytest.approx(20.0, abs=0.01)
    assert profile.pipeline == "road-prior-smoother"


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md"], ids=["readme", "contributing"])
def test_every_link_within_the_project_leads_somewhere(page: str) -> None:
    targets = re.findall(r"\]\((?!https?:)([^)#]+)", (ROOT / page).read_text(encoding="utf-8"))
    assert targets
    for target in targets:
        assert (ROOT / target).exists(), target
