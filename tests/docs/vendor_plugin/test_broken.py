"""Plug-ins that are broken: told in a line each, left out, and all else works."""

import json

import pytest

from floatref import write_recording

pytestmark = pytest.mark.slow

PROJECT = """[build-system]
requires = ["hatchling"]
build-backend = "hatchling.build"

[project]
name = "{name}"
version = "1.0"

[project.entry-points.floatref]
{name} = "{name}"

[project.entry-points.floatref_conformance]
{name} = "{name}"

[tool.hatch.build.targets.wheel]
packages = ["{name}.py"]
"""
REGISTERING = """from floatref import hookimpl


@hookimpl
def floatref_register_adapters(register):
    register({what})
"""
BROKEN = {
    "raises_at_import": 'raise RuntimeError("no licence\\nfor this machine")\n',
    "no_syntax": "def broken(:\n    pass\n",
    "misses_a_module": "import a_module_that_is_nowhere\n",
    "ends_the_program": "import sys\n\nsys.exit(7)\n",
    "registers_nonsense": REGISTERING.format(what="42"),
    "names_no_pipeline": REGISTERING.format(what="42").replace(
        "floatref_register_adapters(register)", "temporal_finish(context)"
    ),
    "misfits_the_hook": REGISTERING.replace("adapters(register)", "adapters(register, colour)"),
}
"""What the module of each plug-in holds."""
SAID = {
    "raises_at_import": "RuntimeError: no licence for this machine",
    "no_syntax": "SyntaxError: ",
    "misses_a_module": "ModuleNotFoundError: No module named 'a_module_that_is_nowhere'",
    "ends_the_program": "SystemExit: 7",
    "registers_nonsense": "TypeError: int has no method recognises",
    "names_no_pipeline": "PluginError: temporal_finish names no pipeline that it answers; write ",
    "misfits_the_hook": "PluginValidationError: ",
}
FAILING = """from floatref import hookimpl


class Failing:
    name, summary = "failing", "whatever ends in .bad"

    def recognises(self, source):
        return source.suffix == ".bad"

    def streams(self, source, options):
        return {}["nothing"]


@hookimpl
def floatref_register_adapters(register):
    register(Failing())
"""
AT_IMPORT = {"raises_at_import", "no_syntax", "misses_a_module", "ends_the_program"}


@pytest.fixture(scope="module")
def broken(installed, tmp_path_factory):
    """The environment of the example, with every broken plug-in installed as well."""
    modules = {**BROKEN, "fails_to_read": FAILING}
    projects = [tmp_path_factory.mktemp(name) for name in modules]
    for project, (name, module) in zip(projects, modules.items(), strict=True):
        (project / "pyproject.toml").write_text(PROJECT.format(name=name))
        (project / f"{name}.py").write_text(module)
    installed.install(*projects)
    return installed


def plugin_warnings(done):
    """Return what is said of each plug-in on standard error, which is one line."""
    lines = [line for line in done.stderr.splitlines() if "plug-in" in line]
    assert done.stderr.splitlines() == lines
    assert "Traceback" not in done.stderr
    return dict(line.removeprefix("Warning: plug-in ").split(" skipped: ", 1) for line in lines)


def test_each_is_told_in_a_line_and_left_out(broken):
    done = broken.run("floatref", "adapters")
    found = plugin_warnings(done)
    assert found.keys() == BROKEN.keys()
    for name, line in found.items():
        assert line.startswith(SAID[name]), name
    assert "acme-roadlogger" in done.stdout
    assert "recording" in done.stdout


@pytest.mark.parametrize("command", [("pipelines",), ("process", "run", "--out", "profile")])
def test_all_else_works(broken, wavy, command):
    write_recording(wavy, broken.folder / "run", overwrite=True)
    done = broken.run("floatref", *command)
    assert AT_IMPORT <= plugin_warnings(done).keys() <= BROKEN.keys()


def test_json_holds_the_warnings(broken):
    found = json.loads(broken.run("floatref", "adapters", "--json").stdout)
    assert len(found["warnings"]) == len(BROKEN)
    assert "acme-roadlogger" in {adapter["name"] for adapter in found["adapters"]}


def test_the_judge_leaves_them_out_as_well(broken):
    whole = broken.run("conformance", "list")
    for name in AT_IMPORT:
        (line,) = [x for x in whole.stderr.splitlines() if f"plug-in {name}: " in x]
        assert line.endswith("it is left out")
    assert "quiescent" in whole.stdout


def test_an_adapter_that_fails_on_a_file_is_named_with_it(broken):
    (broken.folder / "run.bad").write_bytes(b"bytes")
    done = broken.run("floatref", "channels", "run.bad", code=2)
    (line,) = [x for x in done.stderr.splitlines() if not x.startswith("Warning")]
    assert line == "Error: adapter failing: run.bad: KeyError: 'nothing'"


def test_mended_it_is_said_no_more(broken):
    broken.pip("uninstall", "--quiet", "--yes", *(name.replace("_", "-") for name in BROKEN))
    assert broken.run("floatref", "adapters").stderr == ""
