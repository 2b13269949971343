"""The firmware in C with flaws that real firmware has: the judge names the right one first."""

import json
import shutil
import subprocess
import sys

import pytest
from tests.docs.firmware_c.conftest import SOURCE

pytestmark = pytest.mark.slow

TAKEN = "    path->of_samples = causes;\n"
"""The line of `take` before the stage gets force and height."""
LATE = """
/* The height of 2 ms ago: the laser's driver hands over its buffer when it is full. */
static void delay(struct path *path, fr_real *height, size_t n)
{
    size_t lag = (size_t)(0.002 * path->rate_hz);
    for (size_t i = 0; i < n; i++) {
        fr_real now = height[i];
        size_t k = path->given % lag;
        if (path->given >= lag)
            height[i] = path->held[k];
        path->held[k] = now;
        path->given++;
    }
}
"""
FLAWS = {
    "accelerometer-sign": (
        "bounce",
        [
            (
                "firmware.c",
                TAKEN,
                TAKEN + "    for (size_t i = 0; i < n; i++)\n"
                "        force[i] = 2 * 9.80665 - force[i];\n",
            )
        ],
    ),
    "late-laser": (
        "bounce",
        [
            ("firmware.h", "    size_t room, count;\n", "    size_t room, count, given;\n"
             "    fr_real held[128];\n"),
            ("firmware.c", "/* A chunk of samples:", LATE + "\n/* A chunk of samples:"),
            ("firmware.c", TAKEN, TAKEN + "    delay(path, height, n);\n"),
            ("firmware.c", "    TRY(low_passes(path));\n",
             "    path->given = 0;\n    TRY(low_passes(path));\n"),
        ],
    ),
    "height-in-feet": (
        "bounce",
        [
            (
                "firmware.c",
                TAKEN,
                TAKEN + "    for (size_t i = 0; i < n; i++)\n        height[i] /= 0.3048;\n",
            )
        ],
    ),
}  # fmt: skip
"""By the mutant with the same flaw: a check that fails it, and what is changed in which file."""


def build(folder, changes):
    """Return the folder of the firmware with ``changes``, built."""
    shutil.copytree(SOURCE, folder)
    for name, old, new in changes:
        text = (folder / name).read_text(encoding="utf-8")
        assert text.count(old) == 1, (name, old)
        (folder / name).write_text(text.replace(old, new), encoding="utf-8")
    command = ["make", "-s", "-j2", "firmware", f"PYTHON={sys.executable}"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return folder


def find_resemblance(folder, check):
    """Return what a run of ``check`` says the firmware in ``folder`` resembles."""
    words = ["--device", "exec:./firmware", "--check", check, "--resemblance", "--json"]
    done = subprocess.run(
        [sys.executable, "-m", "floatref_conformance", "run", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    assert done.returncode == 1, done.stderr
    return json.loads(done.stdout)["resemblance"]


@pytest.mark.parametrize("flaw", FLAWS)
def test_the_flaw_of_a_firmware_is_named_first(tmp_path, flaw):
    check, changes = FLAWS[flaw]
    found = find_resemblance(build(tmp_path / "firmware", changes), check)
    assert [one["mutant"] for one in found["flaws"]][:1] == [flaw], found


@pytest.mark.nightly
def test_the_firmware_as_it_is_resembles_no_flaw_though_it_fails_a_check(tmp_path):
    """It fails `braking` at each of ten seeds, as the default device of the SDK does."""
    found = find_resemblance(build(tmp_path / "firmware", []), "braking")
    assert found["flaws"] == [], found
