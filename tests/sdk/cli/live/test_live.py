"""`floatref live` as a command: its options, a file that grows, and how it ends."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from click.testing import CliRunner

from floatref import read_profile
from floatref.cli.main import main
from floatref.live.as_live import run_as_live
from floatref.live.session.run_lock import RunLock

LEGS = [(20.0, 200.0)]
PIPELINE = "temporal-basic"
WAIT_S = 300.0


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["--listen", "0", "--host", "0.0.0.0"], "--host 0.0.0.0: lets other hosts connect; give"),
        (["--listen", "0", "--host", "::", "--allow-remote"], "--allow-remote and --token-file"),
        (["--host", "127.0.0.2"], "are for --listen; give a port"),
        (["--listen", "70000"], "--listen is 70000; give a port from 0 to 65535"),
        (["--listen", "0", "--follow", "x"], "both say where messages come from; give one"),
        (["--save-every", "-1"], "--save-every is -1; give 0 to 3600 s"),
        (["--save-every", "nan"], "--save-every is nan; give 0 to 3600 s"),
        (["--follow", "missing.jsonl"], "missing.jsonl: No such file or directory; check the name"),
        (["--resume"], "run: holds no live.json, so no live run to resume"),
        (["--listen", "0", "--token-file", "token"], "token: the token has 5 characters"),
    ],
)
def test_what_cannot_be_is_one_line(tmp_path, monkeypatch, words, line):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "token").write_text("short", encoding="utf-8")
    ended = CliRunner().invoke(main, ["live", "-o", "run", *words])
    assert (ended.exit_code, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert line in ended.stderr
    assert not (tmp_path / "run").exists()


def test_an_existing_directory_is_left_as_it_is(tmp_path):
    (tmp_path / "run").mkdir()
    ended = CliRunner().invoke(main, ["live", "-o", str(tmp_path / "run")])
    assert ended.exit_code == 2
    assert "run: exists; go on with --resume, or choose another name" in ended.stderr


def test_a_run_that_another_command_serves_is_not_resumed(tmp_path):
    lock = RunLock(tmp_path)
    ended = CliRunner().invoke(main, ["live", "-o", str(tmp_path), "--resume"])
    lock.release()
    assert (ended.exit_code, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert "another command serves this run; end that one" in ended.stderr


def start(path, *words, **more):
    command = [sys.executable, "-m", "floatref", "live", "-o", str(path), *map(str, words)]
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more
    )


@pytest.fixture(scope="module")
def run(drive, messages_of):
    recording = drive(LEGS)
    return messages_of(recording, step_s=5.0), run_as_live(recording, PIPELINE).profile


@pytest.mark.slow
def test_a_file_that_grows_is_followed_and_again_after_a_kill(run, as_lines, same, tmp_path):
    messages, expected = run
    source, path = tmp_path / "run.jsonl", tmp_path / "run"
    for message in messages[1:-1]:
        # A file has all samples from the start, so they need no numbers.
        for piece in message["channels"].values():
            piece.pop("first", None)
    data = as_lines(messages)
    with source.open("wb", buffering=0) as growing:
        growing.write(data[: len(data) // 2])
        with start(path, "--follow", source, "--save-every", 0) as process:
            while '"saved"' not in process.stdout.readline():
                pass
            process.kill()
        with start(path, "--follow", source, "--resume") as process:
            assert '"started"' in process.stdout.readline()
            for k in range(len(data) // 2, len(data), 100_000):
                growing.write(data[k : k + 100_000])
                time.sleep(0.01)
            answers = process.stdout.readlines()
            assert process.stderr.read() == ""
    assert process.returncode == 0
    assert json.loads(answers[-1])["kind"] == "finished"
    same(read_profile(path), expected)


@pytest.mark.slow
@pytest.mark.posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_is_saved(run, as_lines, same, tmp_path, number):
    messages, expected = run
    source, path = tmp_path / "run.jsonl", tmp_path / "run"
    source.write_bytes(as_lines(messages[:-1]))
    with start(path, "--follow", source, "--save-every", 3600) as process:
        while '"final"' not in process.stdout.readline():
            pass
        os.kill(process.pid, number)
        assert process.stderr.read() == "Interrupted; the run is saved, go on with --resume\n"
    assert process.returncode == 130
    assert read_profile(path).length_m > 1000.0
    source.write_bytes(as_lines(messages))
    with start(path, "--follow", source, "--resume") as process:
        process.stdout.readlines()
    assert process.returncode == 0
    same(read_profile(path), expected)


@pytest.mark.slow
@pytest.mark.posix
def test_a_reader_that_has_gone_ends_the_command_in_one_line(run, as_lines, tmp_path):
    messages, _ = run
    source, path = tmp_path / "run.jsonl", tmp_path / "run"
    source.write_bytes(as_lines(messages[:-1]))
    with start(path, "--follow", source) as process:
        process.stdout.readline()
        process.stdout.close()
        line = process.stderr.read()
    assert process.returncode == 2
    assert line.endswith("reads no answers any more; what has come is saved, go on with --resume\n")
    assert (path / "live.json").exists()
