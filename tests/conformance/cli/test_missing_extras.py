"""Without the packages of an extra `conformance` says in one line how a clone gets them.

Law: whatever command needs a package that is not installed, its exit code is 2, before it has
simulated, judged or written anything.
"""

import sys

import pytest
from click.testing import CliRunner

from floatref_conformance.cli.main import main

CASES = [
    ("conformance", "hypothesis", ("run",)),
    ("conformance", "hypothesis", ("selftest",)),
    ("conformance", "jinja2", ("run", "--report", "report")),
    ("conformance", "jinja2", ("certify", "road", "--reference", "road", "--report", "report")),
    ("conformance", "pycrg", ("simulate", "road.json", "--out", "run")),
    ("plot", "matplotlib", ("table", "--plot", "t.png")),
    ("plot", "matplotlib", ("table", "--family", "urban", "--plot", "t.png")),
    ("plot", "matplotlib", ("table", "--stops", "9", "--plot", "t.png")),
]


@pytest.mark.parametrize(("extra", "package", "command"), CASES)
def test_a_missing_package_is_one_line_that_works_in_a_clone(
    extra, package, command, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "road.json").write_text('{"road": "measured:a.crg"}')
    (tmp_path / "a.crg").write_bytes(b"$CT\n")
    rows = "".join(f"{i / 4},0.01,1\n" for i in range(9))
    (tmp_path / "road").write_text("distance_m,left_elevation_m,left_valid\n" + rows)
    before = sorted(tmp_path.rglob("*"))
    inside = [name for name in sys.modules if name.split(".")[0] == package]
    for name in {package, *inside}:
        monkeypatch.setitem(sys.modules, name, None)
    result = CliRunner().invoke(main, command)
    assert (result.exit_code, result.stdout) == (2, ""), result.output
    lines = [line for line in result.stderr.splitlines() if line.startswith("Error: ")]
    assert len(lines) == 1
    assert f'run in a clone of floatref: pip install -e ".[{extra}]"' in lines[0]
    assert "Traceback" not in result.stderr
    assert sorted(tmp_path.rglob("*")) == before
