"""The golden program of the firmware example passes all vectors of stages that one call replays.

Those of the two smoothers are replayed by the tests of the library alone.
"""

import subprocess

import pytest

from floatref_conformance import golden

SMOOTHERS = {"kalman-smoother", "road-prior-smoother"}


def replayed(program, folder):
    found = subprocess.run([program, folder], capture_output=True, text=True)
    return found.returncode, found.stdout


@pytest.mark.slow
@pytest.mark.parametrize("real", ["double", "float"])
def test_the_program_passes_every_vector_but_those_of_the_smoothers(build, real, tmp_path):
    golden.copy_to(tmp_path)
    code, said = replayed(build("golden", f"REAL={real}"), tmp_path)
    assert code == 0, said
    assert set(golden.names()) > SMOOTHERS
    assert said.count("pass  ") == len(golden.names()) - len(SMOOTHERS)
    assert "FAIL" not in said


@pytest.mark.slow
def test_a_wrong_stage_fails_its_golden_vectors_and_no_others(build, tmp_path):
    golden.copy_to(tmp_path)
    code, said = replayed(build("golden", "CPPFLAGS=-Dtan=sin"), tmp_path)
    assert code == 1
    failed = {line.split()[1] for line in said.splitlines() if line.startswith("FAIL")}
    assert {"lpf-b3s1.json", "hpf-b3s1.json", "hpf-b3s2.json"} <= failed
    assert failed.isdisjoint({"trapezoidal-rule.json", "projection.json", "validity.json"})
