"""`floatref live --display --web`: answers alone on standard output, and a page has the run."""

import json
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
from math import nan

import pytest
from click.testing import CliRunner

from floatref import read_profile
from floatref.cli.main import main
from floatref.live.monitor.sections import SECTION_M, SHOWN
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.valid_segments import segment_iris

PIPELINE = "temporal-matched-hpf"
WAIT_S = 300.0


@pytest.mark.parametrize("port", ["65536", "1000000"])
def test_a_port_that_is_no_port_is_one_line(tmp_path, port):
    ended = CliRunner().invoke(main, ["live", "-o", str(tmp_path / "run"), f"--web={port}"])
    assert (ended.exit_code, ended.stdout) == (2, "")
    assert f"--web is {port}; give a port from 0 to 65535" in ended.stderr
    assert not (tmp_path / "run").exists()


@pytest.mark.slow
def test_without_a_view_nothing_that_draws_is_loaded():
    code = (
        "import sys, floatref.cli.live.command; print([m for m in sys.modules if 'monitor' in m])"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout == "[]\n"


def state_at(address):
    with urllib.request.urlopen(f"{address}state.json", timeout=WAIT_S) as answer:
        return json.load(answer)


class Shown:
    """`floatref live` with both views; its answers are read by a thread."""

    def __init__(self, path, *words):
        command = [sys.executable, "-m", "floatref", "live", "-o", str(path), "--display", "--web"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(
            [*command, *words], stdin=pipe, stdout=pipe, stderr=pipe, text=True
        )
        self.kinds = []
        self.address = self.process.stderr.readline().split()[-1]
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.kinds.append(json.loads(line)["kind"])

    def send(self, messages):
        for each in messages:
            self.process.stdin.write(json.dumps(each) + "\n")
        self.process.stdin.flush()

    def until(self, is_so):
        """Return the first state that is so."""
        end_s = time.monotonic() + WAIT_S
        while not is_so(state := state_at(self.address)):
            assert time.monotonic() < end_s, state
            time.sleep(0.05)
        return state

    def end(self):
        """Return the exit code and what was written on standard error since the address."""
        self.process.stdin.close()
        rest = self.process.stderr.read()
        code = self.process.wait(WAIT_S)
        self.reader.join(WAIT_S)
        self.process.stdout.close()
        self.process.stderr.close()
        return code, rest


def has_final(state):
    return any(section["is_final"] for section in state["sections"])


@pytest.mark.slow
def test_a_run_is_shown_and_resumed_with_its_sections(drive, messages_of, tmp_path):
    path, more = tmp_path / "run", {"pipeline": PIPELINE, "provisional": True}
    hello, *pieces, finish = messages_of(drive([(20.0, 260.0)]), 5.0, **more)
    run = Shown(path)
    run.send([hello, *pieces[: 3 * len(pieces) // 4]])
    state = run.until(has_final)
    code, rest = run.end()
    assert code == 2
    assert set(run.kinds) == {"started", "points", "saved"}
    assert (state["status"], state["fault"], state["pipeline"]) == ("running", "", PIPELINE)
    assert "run interrupted: standard input: ended without the message finish" in rest
    with pytest.raises(urllib.error.URLError):
        state_at(run.address)
    run = Shown(path, "--resume")
    run.send([hello])
    assert has_final(run.until(lambda state: state["status"] == "running"))
    run.send([*pieces, finish])
    state = run.until(lambda state: state["closing"])
    assert run.end()[0] == 0
    assert run.kinds[-1] == "finished"
    assert (state["status"], state["fault"]) == ("complete", "")
    assert_sections(state["sections"], read_profile(path))


def assert_sections(found, profile):
    settings = IriSettings(segment_m=SECTION_M)
    expected = segment_iris(profile.track("left"), profile.interval_m, settings, profile.start_m)
    expected = expected[-SHOWN:]
    starts = [s.start_m for s in expected]
    assert [s["start_m"] for s in found] == pytest.approx(starts)
    iris = [s.valid_m_per_km for s in expected]
    shown = [s["tracks"][0]["iri_m_per_km"] for s in found]
    known = [nan if each is None else each for each in shown]
    assert known == pytest.approx(iris, rel=1e-6, nan_ok=True)
