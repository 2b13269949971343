"""`conformance submit` and `verify` as commands: exit codes, lines, and nothing half-written."""

import json
import subprocess

import pytest
from click.testing import CliRunner
from tests.conformance.submission.conftest import load

from floatref.cli.program.interrupts import Interrupt
from floatref_conformance.cli import judging_options
from floatref_conformance.cli.main import main
from floatref_conformance.cli.submissions import submit as submit_command
from floatref_conformance.cli.submissions import verify as verify_command
from floatref_conformance.cli.submissions.verify import FORMAT
from floatref_conformance.resemblance import naming
from floatref_conformance.submission.checksums import SUMS, list_sums
from floatref_conformance.submission.stored_zip import read_archive, write_archive


@pytest.fixture
def call(monkeypatch, tmp_path):
    """Return a function that runs a command on the toy check in an empty folder."""
    for module in (submit_command, verify_command):
        monkeypatch.setattr(module, "load_registry", load)
    # The probes are drives of the proving ground, which say nothing of a toy.
    monkeypatch.setattr(judging_options, "add_resemblance", lambda result, device: result)
    monkeypatch.chdir(tmp_path)
    return lambda *words: CliRunner().invoke(main, [*map(str, words)])


@pytest.fixture
def submit(call):
    return lambda name, *words: call("submit", "--device", f"fake:{name}", "-o", "a.zip", *words)


@pytest.mark.slow
def test_a_failure_is_submitted_and_confirmed(call, submit, tmp_path):
    ended = submit("clipping")
    assert ended.exit_code == 1, ended.output
    assert ended.stdout.startswith("FAIL: ")
    assert "unsigned" in ended.stdout
    verified = call("verify", "a.zip", "--device", "fake:clipping")
    assert verified.exit_code == 0, verified.output
    assert "a.zip states FAIL; unsigned" in verified.stdout
    assert verified.stdout.endswith("confirmed: nothing contradicts\n")
    assert [p.name for p in tmp_path.iterdir()] == ["a.zip"]


@pytest.mark.slow
def test_the_same_input_gives_the_same_archive(submit, tmp_path):
    submit("clipping")
    before = (tmp_path / "a.zip").read_bytes()
    submit("clipping", "--overwrite")
    assert (tmp_path / "a.zip").read_bytes() == before


@pytest.mark.slow
def test_cases_of_another_hypothesis_end_with_2_and_name_it(call, submit, tmp_path):
    submit("good")
    members = dict(read_archive(tmp_path / "a.zip"))
    stated, results = (json.loads(members[n]) for n in ("submission.json", "results/toy.json"))
    stated["environment"]["hypothesis"] = "1.2.3"
    searched = next(result for result in results if "-search-" in result["name"])
    searched["parameters"]["scenario"]["speed_kmh"] = 33.25
    members |= {"submission.json": json.dumps(stated).encode()}
    members |= {"results/toy.json": json.dumps(results).encode()}
    members.pop(SUMS)
    write_archive(members | {SUMS: list_sums(members)}, tmp_path / "a.zip", overwrite=True)
    verified = call("verify", "a.zip")
    assert verified.exit_code == 2, verified.output
    assert "Undecided: the archive states hypothesis 1.2.3" in verified.stdout
    assert verified.stdout.endswith("not confirmed: it was not repeated\n")
    found = json.loads(call("verify", "a.zip", "--json").stdout)
    assert not found["confirmed"]
    assert "1.2.3" in found["undecided"]


@pytest.mark.slow
def test_a_tampered_archive_ends_with_1_and_names_the_place(call, submit, tmp_path):
    submit("good", "--check", "toy")
    members = read_archive(tmp_path / "a.zip")
    report = json.loads(members["report.json"])
    report["verdict"] = "PASS"
    members["report.json"] = json.dumps(report).encode()
    write_archive(members, tmp_path / "b.zip")
    verified = call("verify", "b.zip", "--json")
    found = json.loads(verified.stdout)
    assert (verified.exit_code, found["format"], found["confirmed"]) == (1, FORMAT, False)
    assert {f["caught_by"] for f in found["findings"]} == {"checksums", "repetition"}
    assert "Contradicted (repetition): report.json: verdict" in call("verify", "b.zip").stdout


@pytest.mark.slow
def test_signature_statement_and_waiver_are_in_it(call, submit, tmp_path):
    words = ("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", "key")
    subprocess.run(words, check=True, cwd=tmp_path)
    (tmp_path / "signers").write_text(f"lab@example.org {(tmp_path / 'key.pub').read_text()}")
    (tmp_path / "words.txt").write_text("Firmware 7 of vehicle 3.")
    (tmp_path / "waived.txt").write_text("toy  a new laser in March")
    words = ("--sign", "key", "--statement", "words.txt", "--waive", "waived.txt")
    assert submit("clipping", *words).exit_code == 4
    members = read_archive(tmp_path / "a.zip")
    submission = json.loads(members["submission.json"])
    assert submission["statement"] == "Firmware 7 of vehicle 3."
    assert submission["waivers"] == [{"check": "toy", "reason": "a new laser in March"}]
    verified = call("verify", "a.zip", "--signers", "signers")
    assert verified.exit_code == 0
    assert "a.zip states INCOMPLETE; signed by lab@example.org" in verified.stdout


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("--waive", "bare.txt"), "toy: no reason"),
        (("--sign", "bare.txt"), "cannot sign with it"),
        (("--sign", "missing"), "missing: No such file"),
        (("--statement", "latin.txt"), "latin.txt: not UTF-8"),
        (("--device-file", "missing"), "missing: No such file"),
        (("--check", "toys"), "did you mean toy?"),
    ],
)
def test_what_cannot_be_used_is_refused_before_the_run(submit, tmp_path, words, text):
    (tmp_path / "bare.txt").write_text("toy\n")
    (tmp_path / "latin.txt").write_bytes(b"\xe4")
    ended = submit("good", *words)
    assert (ended.exit_code, ended.stdout) == (2, "")
    assert text in ended.stderr
    assert "cases" not in ended.stderr
    assert not (tmp_path / "a.zip").exists()


def test_an_archive_of_somebody_else_ends_with_2(call, tmp_path):
    write_archive({"a.txt": b"one"}, tmp_path / "a.zip")
    ended = call("verify", "a.zip")
    assert (ended.exit_code, ended.stdout) == (2, "")
    assert ended.stderr == "Error: a.zip: no SHA256SUMS; give an archive of `conformance submit`\n"


@pytest.mark.slow
def test_an_archive_whose_probes_were_interrupted_is_whole(call, submit, monkeypatch):
    def interrupt(*_, **__):
        raise Interrupt

    monkeypatch.setattr(naming, "ask_probes", interrupt)
    monkeypatch.setattr(judging_options, "add_resemblance", naming.add_resemblance)
    ended = submit("clipping")
    assert ended.exit_code == 130
    assert "FAIL: " in ended.stdout
    assert ended.stderr.splitlines()[-1].startswith("Interrupted: the verdict is kept")
    verified = call("verify", "a.zip")
    assert verified.exit_code == 0
    assert f"by the word of the report, {naming.INTERRUPTED}" in verified.stdout
