"""A submission of a real check: on another checkout, edition and processor.

The processor is one that rounds the last digits of all samples and of the truth in another way.
"""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.checks.interface import fit_check
from floatref_conformance.cli.main import main
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.bench import DeviceBench, make_taken
from floatref_conformance.judge.replaying import judge_case
from floatref_conformance.plugins import load_registry
from floatref_conformance.submission.agreement import SCORED, compare_results
from floatref_conformance.submission.checksums import list_sums
from floatref_conformance.submission.document import read_submission
from floatref_conformance.submission.findings import Verification
from floatref_conformance.submission.rejudging import Repetition
from floatref_conformance.submission.rescoring import list_stored
from floatref_conformance.submission.stored_answers import StoredAnswers, read_passes
from floatref_conformance.submission.stored_zip import read_archive
from floatref_conformance.submission.verifying import Wanted, read_results, verify

ROOT = Path(__file__).parents[3]
ROOMS = ("sdk", "adapters", "reference_impl", "conformance")
ROUNDING = 1e-13
"""Some hundred roundings of float64."""

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """The archive of a device that the check `bounce` fails."""
    path = tmp_path_factory.mktemp("real") / "a.zip"
    words = ["submit", "--device", "mutant:all-zeros", "--check", "bounce", "-o", str(path)]
    ended = CliRunner().invoke(main, words)
    assert ended.exit_code == 1, ended.output
    return path


def test_another_checkout_confirms_it(path, tmp_path):
    for room in ROOMS:
        # With what is compiled there, which takes a minute.
        shutil.copytree(ROOT / room, tmp_path / room)
    places = os.pathsep.join(str(tmp_path / room) for room in ROOMS)
    words = (sys.executable, "-m", "floatref_conformance", "verify", str(path), "--json")
    done = subprocess.run(
        words, env={**os.environ, "PYTHONPATH": places}, cwd=tmp_path, capture_output=True
    )
    found = json.loads(done.stdout)
    assert (done.returncode, found["confirmed"], found["claimed"]) == (0, True, "FAIL")
    lines = "\n".join(found["repeated"])
    assert "bit for bit" in lines
    assert "simplified, scored from the stored profiles: fails: " in lines
    assert "cases on the device mutant:all-zeros" in lines


def test_another_edition_draws_other_cases(path):
    members = read_archive(path)
    for name in ("submission.json", "report.json"):
        document = json.loads(members[name])
        members[name] = json.dumps({**document, "edition": "2026.1"}).encode()
    members["SHA256SUMS"] = list_sums({n: m for n, m in members.items() if n != "SHA256SUMS"})
    (found,) = verify(members, Wanted()).findings
    assert "edition and seed draw bounce-1 here" in found.what


def rounded_otherwise(scenario):
    """Simulate ``scenario`` on a processor that rounds in another way."""
    taken, draw = make_taken(scenario), np.random.default_rng(0)

    def change(values):
        return np.array(values) * (1.0 + ROUNDING * draw.uniform(-1.0, 1.0, values.size))

    channels = tuple(replace(c, values=change(c.values)) for c in taken.recording.channels)
    tracks = tuple(ProfileTrack.of(t.name, change(t.elevation)) for t in taken.truth.tracks)
    truth = Profile(taken.truth.interval_m, tracks, taken.truth.start_m)
    return replace(taken, recording=Recording(channels, taken.recording.setup), truth=truth)


def test_figures_agree_where_a_processor_rounds_otherwise(path):
    members = read_archive(path)
    submission = read_submission(members["submission.json"])
    repetition = Repetition(
        members, submission, read_results(members), load_registry(), Verification()
    )
    for stored in list_stored(members):
        device = StoredAnswers(read_passes(stored.files, "answer"), submission.description)
        bench = DeviceBench(device, submission.describe(), rounded_otherwise, find_edition())
        check = fit_check(load_registry().check("bounce"), submission.describe().meets)
        again = judge_case(check, stored.case, bench)
        before = repetition.find(stored.case)
        assert [m.value for m in again.measurements] != [m.value for m in before.measurements]
        assert list(compare_results(before, again, SCORED)) == []
        assert device.inputs != [dict(digests) for digests in stored.inputs]
