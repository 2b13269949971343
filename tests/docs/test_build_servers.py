"""The examples for build servers: sound YAML, pinned actions, and shell steps that run.

The installation alone is replaced: a `python3` that makes an environment with the suite under test.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
FILES = {
    name: EXAMPLES / name
    for name in ("github/action.yml", "github/conformance.yml", "gitlab/conformance.yml")
}
PINNED = re.compile(r"(\./[\w./-]+|[\w.-]+/[\w.-]+@v\d+\.\d+\.\d+)")
SKIPS = """
import json, sys
for line in sys.stdin:
    asked = json.loads(line)
    about = {"name": "busy", "version": "1", "architecture": "temporal", "capabilities": []}
    answers = {"start": {"version": 1, "device": about}, "run": {"skipped": "no time"}}
    print(json.dumps({"seq": asked["seq"], **answers.get(asked["cmd"], {})}), flush=True)
"""
"""A device that skips every recording: the verdict is INCOMPLETE, exit code 4."""
PYTHON3 = f"""#!/bin/sh
mkdir -p "$3/bin"
printf '#!/bin/sh\\necho "$@" > pip.txt\\n' > "$3/bin/pip"
printf '#!/bin/sh\\nexec {sys.executable} -m floatref_conformance "$@"\\n' > "$3/bin/conformance"
chmod +x "$3/bin/pip" "$3/bin/conformance"
"""


def load(name):
    return yaml.safe_load(FILES[name].read_text(encoding="utf-8"))


def steps_of(name):
    document = load(name)
    if "runs" in document:
        return document["runs"]["steps"]
    return [step for job in document.get("jobs", {}).values() for step in job["steps"]]


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A folder of a vendor with a device, in which a build server begins."""
    (tmp_path / "busy.py").write_text(SKIPS)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python3").write_text(PYTHON3)
    (tmp_path / "bin" / "python3").chmod(0o755)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run_shell(text, workspace, **variables):
    """Run ``text`` as both servers do, in bash that ends at the first error."""
    environment = {**os.environ, **variables, "PATH": f"{workspace / 'bin'}:{os.environ['PATH']}"}
    command = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", text]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("name", ["github/action.yml", "github/conformance.yml"])
def test_actions_are_pinned_and_inputs_are_no_commands(name):
    steps = steps_of(name)
    assert [step["uses"] for step in steps if not PINNED.fullmatch(step.get("uses", "./x"))] == []
    assert [step for step in steps if "${{" in step.get("run", "")] == []


def test_inputs_are_declared_used_and_given():
    declared = load("github/action.yml")["inputs"]
    text = FILES["github/action.yml"].read_text(encoding="utf-8")
    assert set(re.findall(r"inputs\.(\w+)", text)) == set(declared)
    assert all("default" in one or one["required"] for one in declared.values())
    steps = steps_of("github/conformance.yml")
    (given,) = [step["with"] for step in steps if step.get("uses", "").startswith("./")]
    assert set(given) <= set(declared)
    assert {name for name, one in declared.items() if one.get("required")} <= set(given)


def check_end(workspace):
    """Assert that report and matrix are there, and what was installed."""
    report = json.loads((workspace / "reports" / "fw" / "report.json").read_text())
    assert (report["verdict"], report["device"]["name"]) == ("INCOMPLETE", "busy")
    assert (workspace / "matrix.html").read_text().startswith("<!DOCTYPE html>")
    words = (workspace / "pip.txt").read_text().split()
    assert words[:2] == ["install", "--quiet"]
    return words[-1]


@pytest.mark.slow
@pytest.mark.posix
def test_the_steps_of_the_action_run(workspace):
    given = {"device": f"exec:{sys.executable} busy.py", "name": "fw", "checks": "quiescent"}
    inputs = {k: v.get("default", "") for k, v in load("github/action.yml")["inputs"].items()}
    inputs |= given
    places = {
        "RUNNER_TEMP": str(workspace / "temp"),
        "GITHUB_ACTION_PATH": str(EXAMPLES / "github"),
        "GITHUB_STEP_SUMMARY": str(workspace / "summary.md"),
    }
    codes = []
    for step in (s for s in steps_of("github/action.yml") if "run" in s):
        named = {k: inputs[v[11:-3]] for k, v in step.get("env", {}).items()}
        ended = run_shell(step["run"], workspace, **places, **named)
        codes.append(ended.returncode)
        assert codes[-1] in (0, 4), ended.stderr
    assert codes == [0, 4, 0]
    installed = check_end(workspace).removesuffix("[conformance]")
    assert (Path(installed) / "pyproject.toml").is_file()
    summary = (workspace / "summary.md").read_text()
    assert summary.startswith("```text\n")
    assert "busy" in summary


@pytest.mark.slow
@pytest.mark.posix
def test_the_job_of_the_template_runs(workspace):
    template, job = load("gitlab/conformance.yml")[".conformance"], load("gitlab/conformance.yml")
    assert job["conformance"]["extends"] == ".conformance"
    assert template["artifacts"]["when"] == "always"
    subprocess.run(["git", "init", "-q", "-b", "main", "origin"], check=True)
    (workspace / "origin" / "pyproject.toml").write_text("")
    identity = ("-c", "user.name=a", "-c", "user.email=a@example.org")
    for words in (("add", "."), (*identity, "commit", "-qm", "one")):
        subprocess.run(["git", "-C", "origin", *words], check=True)
    variables = template["variables"] | {
        "SUITE_REPOSITORY": f"file://{workspace}/origin",
        "DEVICE": f"exec:{sys.executable} busy.py",
        "NAME": "fw",
        "CHECKS": "quiescent",
    }
    text = "\n".join([*template["before_script"], *template["script"]])
    ended = run_shell(text, workspace, **variables)
    assert ended.returncode == 4, ended.stderr
    assert check_end(workspace) == "./suite[conformance]"
    assert (workspace / "suite" / "pyproject.toml").is_file()


@pytest.mark.parametrize("name", FILES)
def test_the_page_names_the_file(name):
    page = (EXAMPLES.parent / "build-servers.md").read_text(encoding="utf-8")
    assert f"](examples/{name})" in page
