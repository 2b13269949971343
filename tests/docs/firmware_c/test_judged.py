"""The judge passes the firmware in C, and fails the faults that are built into it."""

import re
import subprocess
import sysconfig
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

README = Path(__file__).parents[3] / "docs" / "examples" / "firmware_c" / "README.md"
CONFORMANCE = Path(sysconfig.get_path("scripts")) / "conformance"


def judged(program, *checks):
    """Return exit code and output of a quick run of ``checks``."""
    options = [word for check in checks for word in ("--check", check)]
    found = subprocess.run(
        [str(CONFORMANCE), "run", "--device", "exec:./firmware", *options],
        cwd=program.parent,
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    return found.returncode, found.stdout + found.stderr


def test_the_firmware_keeps_the_limits_where_it_is_hardest(build):
    code, said = judged(build("firmware"), "faults")
    assert "1 of 1 checks that ran passed" in said
    assert code == 4


# The tutorial shows the failure of the second one, and its test runs that.
@pytest.mark.parametrize(("fault", "check"), [(1, "bounce"), (2, "near-stop")])
def test_a_fault_fails_a_check_that_the_readme_names(build, fault, check):
    readme = README.read_text(encoding="utf-8")
    assert f"`{check}`" in re.search(rf"^\| `BROKEN={fault}` \| .*$", readme, re.M)[0]
    code, said = judged(build("firmware", f"BROKEN={fault}"), check)
    assert f"\n{check}: fail" in said
    assert code == 1
