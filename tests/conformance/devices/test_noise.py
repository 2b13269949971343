"""A device that prints to standard output: one line names what it printed, JSON stays JSON."""

import json
import sys

import pytest
from click.testing import CliRunner

import floatref
from floatref.files import write_recording
from floatref_conformance.cli.main import main
from floatref_conformance.devices import builtin

NOISY = """
import json, sys
print(NOISE, flush=True)
for line in sys.stdin:
    print(json.dumps({"seq": json.loads(line)["seq"], "version": 1, "device": {}}), flush=True)
"""


@pytest.mark.parametrize("noise", ["Booting, firmware 1.2", "{", "12", '"ready"', "\x1b[31mred"])
def test_a_line_that_is_no_answer_is_named_and_json_stays_whole(noise, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "noisy.py").write_text(NOISY.replace("NOISE", repr(noise)))
    device = f"exec:{sys.executable} noisy.py"
    ended = CliRunner().invoke(main, ["run", "--device", device, "--check", "bounce", "--json"])
    assert ended.exit_code == 1
    (check,) = (c for c in json.loads(ended.stdout)["checks"] if c["id"] == "bounce")
    assert "start: the answer is not " in check["reason"]
    assert noise.lstrip("\x1b") in check["reason"]
    assert "stdout is for answers alone, messages go to stderr" in check["reason"]
    assert check["reason"].count("\n") == 0


def test_what_a_pipeline_prints_is_not_in_the_report(monkeypatch, capsys, recording, tmp_path):
    process = floatref.process

    def printing(*arguments):
        print("a plug-in at work")
        return process(*arguments)

    monkeypatch.setattr(floatref, "process", printing)
    write_recording(recording, tmp_path / "run")
    builtin.make("temporal-basic").run(tmp_path / "run", tmp_path / "profile")
    assert capsys.readouterr() == ("", "a plug-in at work\n")
