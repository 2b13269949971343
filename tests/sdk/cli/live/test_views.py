"""`floatref live --display --web`: answers alone on standard output, and a page has the run."""

import json
import subprocess
import sys
import threading
import urllib.error
import urllib.request

import pytest
from click.testing import CliRunner

from floatref import read_profile
from floatref.cli.main import main
from floatref.live.monitor.sections import SECTION_M
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.valid_segments import segment_iris

PIPELINE = "temporal-matched-hpf"


@pytest.mark.parametrize("port", ["-1", "65536"])
def test_a_port_that_is_no_port_is_one_line(tmp_path, port):
    ended = CliRunner().invoke(main, ["live", "-o", str(tmp_path / "run"), "--web", port])
    assert (ended.exit_code, ended.stdout) == (2, "")
    assert f"--web is {port}; give a port from 0 to 65535" in ended.stderr
    assert not (tmp_path / "run").exists()


def test_without_a_view_nothing_that_draws_is_loaded():
    code = (
        "import sys, floatref.cli.live.command; print([m for m in sys.modules if 'monitor' in m])"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout == "[]\n"


def state_at(address):
    with urllib.request.urlopen(f"{address}state.json", timeout=60.0) as answer:
        return json.load(answer)


def start(path, *words):
    command = [sys.executable, "-m", "floatref", "live", "-o", str(path), "--display", "--web"]
    pipe = subprocess.PIPE
    return subprocess.Popen([*command, *words], stdin=pipe, stdout=pipe, stderr=pipe, text=True)


@pytest.mark.slow
def test_a_run_is_shown_and_resumed_with_its_sections(drive, messages_of, tmp_path):
    hello, *pieces, finish = messages_of(
        drive([(20.0, 260.0)]), 5.0, pipeline=PIPELINE, provisional=True
    )
    path, half = tmp_path / "run", 3 * len(pieces) // 4
    with start(path) as process:
        address = process.stderr.readline().split()[-1]
        kinds = send_until(process, [hello, *pieces[:half]], lambda: has_final(address))
        state = state_at(address)
        process.stdin.close()
        kinds += [json.loads(line)["kind"] for line in process.stdout]
        last = process.stderr.read()
    assert process.returncode == 2
    assert set(kinds) == {"started", "points", "saved"}
    assert (state["status"], state["fault"], state["pipeline"]) == ("running", "", PIPELINE)
    assert "run interrupted: standard input: ended without the message finish" in last
    with pytest.raises(urllib.error.URLError):
        state_at(address)
    with start(path, "--resume") as process:
        address = process.stderr.readline().split()[-1]
        kinds = send_until(process, [hello], lambda: state_at(address)["status"] == "running")
        resumed = state_at(address)
        kinds += send_until(process, [*pieces, finish], lambda: True)
        while not resumed["closing"]:
            resumed = {**resumed, **state_at(address)}
        kinds += [json.loads(line)["kind"] for line in process.stdout]
        process.stderr.read()
    assert process.returncode == 0
    assert kinds[-1] == "finished"
    assert (resumed["status"], resumed["fault"]) == ("complete", "")
    profile = read_profile(path)
    settings = IriSettings(segment_m=SECTION_M)
    expected = segment_iris(profile.track("left"), profile.interval_m, settings, profile.start_m)
    assert [s["start_m"] for s in resumed["sections"]] == pytest.approx(
        [s.start_m for s in expected]
    )
    assert [s["tracks"][0]["iri_m_per_km"] for s in resumed["sections"]] == pytest.approx(
        [s.valid_m_per_km for s in expected], rel=1e-6
    )


def has_final(address):
    return any(section["is_final"] for section in state_at(address)["sections"])


def send_until(process, messages, is_done):
    """Send ``messages`` while answers are read; return the kinds of those read until it is done."""

    def send():
        process.stdin.write(as_text(messages))
        process.stdin.flush()

    sender, kinds = threading.Thread(target=send, daemon=True), []
    sender.start()
    while not kinds or not is_done():
        kinds.append(json.loads(process.stdout.readline())["kind"])
    sender.join(60.0)
    return kinds


def as_text(messages):
    return "".join(json.dumps(each) + "\n" for each in messages)
