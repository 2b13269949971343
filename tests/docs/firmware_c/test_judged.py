"""The judge passes the firmware in C, and fails the faults that are built into it."""

import json
import re
import subprocess
import sysconfig
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

DOCS = Path(__file__).parents[3] / "docs"
README, PAGE = DOCS / "examples" / "firmware_c" / "README.md", DOCS / "firmware.md"
WORDS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
WORDS += ("eleven", "twelve", "thirteen", "fourteen", "fifteen")
CONFORMANCE = Path(sysconfig.get_path("scripts")) / "conformance"


def run(program, *options):
    """Return a finished quick run of the judge."""
    return subprocess.run(
        [str(CONFORMANCE), "run", "--device", "exec:./firmware", *options],
        cwd=program.parent,
        capture_output=True,
        text=True,
        encoding="utf-8",
    )


def judged(program, *checks):
    """Return exit code and output of a quick run of ``checks``."""
    found = run(program, *(word for check in checks for word in ("--check", check)))
    return found.returncode, found.stdout + found.stderr


def report_of(program, *checks):
    """Return exit code and report of a quick run of ``checks``, or of all, by their names."""
    done = run(program, "--json", *(word for check in checks for word in ("--check", check)))
    reported = {check["id"]: check for check in json.loads(done.stdout)["checks"]}
    return done.returncode, {name: reported[name] for name in checks or reported}


def rows_of_the_page():
    """Return worst figure, unit and limit of each check that fails, as the page has them."""
    rows = re.findall(
        r"^\| `([a-z-]+)`.*?\| ([\d.]+) (\S+) \| ([\d.]+) \S+ \|", PAGE.read_text(), re.M
    )
    return {name: (float(worst), unit, float(limit)) for name, worst, unit, limit in rows}


def hold_to_the_page(checks):
    """Compare worst figure, unit and limit of each check of the page with those of a run."""
    for name, (worst, unit, limit) in rows_of_the_page().items():
        shown = checks[name]["shown"]
        assert unit == shown["unit"], name
        assert worst == pytest.approx(shown["value"], rel=0.01), name
        assert limit == pytest.approx(shown["limit"], rel=0.05), name


@pytest.mark.nightly
def test_the_page_counts_and_names_what_the_judge_fails(build):
    """All checks in one run: how many pass, and the worst figure and limit of each that fails."""
    code, checks = report_of(build("firmware"))
    failed = {name for name, check in checks.items() if check["outcome"] != "pass"}
    page = " ".join(PAGE.read_text(encoding="utf-8").split())
    counts = f"passes {WORDS[len(checks) - len(failed)]} of the"
    assert f"The finished firmware {counts}" in page
    assert f"the exit code is {code}. It fails {WORDS[len(failed)]}:" in page
    assert failed == rows_of_the_page().keys()
    hold_to_the_page(checks)
    assert "faults" not in failed


@pytest.mark.nightly
def test_what_the_page_names_fails_by_its_figures(build):
    names = rows_of_the_page()
    _, checks = report_of(build("firmware"), *names)
    assert {name for name, check in checks.items() if check["outcome"] == "fail"} == names.keys()
    hold_to_the_page(checks)


# The tutorial shows the failure of the second one, and its test runs that.
@pytest.mark.parametrize(("fault", "check"), [(1, "bounce"), (2, "near-stop")])
def test_a_fault_fails_a_check_that_the_readme_names(build, fault, check):
    readme = README.read_text(encoding="utf-8")
    assert f"`{check}`" in re.search(rf"^\| `BROKEN={fault}` \| .*$", readme, re.M)[0]
    code, said = judged(build("firmware", f"BROKEN={fault}"), check)
    assert f"\n{check}: fail" in said
    assert code == 1


def test_with_the_road_prior_the_judge_passes_its_stops(build):
    """Exit code 4: both checks passed, and the others were not run."""
    code, said = judged(build("firmware", "STAGE=road_prior"), "stop", "near-stop")
    assert "\nstop: pass" in said
    assert "\nnear-stop: pass" in said
    assert code == 4


def test_a_laser_beside_its_accelerometer_is_carried_between_brakes(build):
    code, said = judged(build("firmware", "STAGE=road_prior"), "throttle", "dead-start")
    assert "\nthrottle: pass" in said
    assert "\ndead-start: pass" in said
    assert code == 4
