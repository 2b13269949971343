"""The commands that are told: they mean in the user's folder what they meant in the run."""

import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner

from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.cli import replay, run
from floatref_conformance.cli.main import main
from floatref_conformance.render import wording

SPEC = "exec:./firmware 'x y'"


@pytest.mark.parametrize("folder", [Path("re port"), Path("../there/r"), Path("/abs/r"), None])
def test_a_case_is_replayed_from_the_folder_where_the_run_was_started(result, check, folder):
    made = result(check(Outcome.FAIL), given=(None, folder), spec=SPEC)
    words = shlex.split(wording.replay_command("cases/stop-1a2b3c4d.json", made))
    assert words[:2] == ["conformance", "replay"]
    assert Path(words[2]) == (folder or Path()) / "cases" / "stop-1a2b3c4d.json"
    assert words[3:] == ["--device", SPEC, "--class", "nominal"]
    assert wording.replay_command("stop-1a2b3c4d.json", made) == shlex.join(words)


@pytest.mark.parametrize("limit_s", [0.1, 2.5, 120.0, 1e6])
def test_the_time_that_was_given_is_given_again(result, check, limit_s):
    made = result(check(Outcome.FAIL), given=(limit_s, Path("r")))
    for command in (wording.replay_command("a.json", made), wording.reproduction(made)):
        words = shlex.split(command)
        assert float(words[words.index("--device-timeout") + 1]) == limit_s
        assert words.count("--device-timeout") == 1
    without = result(check(Outcome.FAIL))
    assert "--device-timeout" not in wording.replay_command("a.json", without)
    assert "--device-timeout" not in wording.reproduction(without)


@pytest.mark.parametrize("module", [replay, run])
def test_what_is_told_is_taken_by_the_command_line(result, check, module, monkeypatch):
    made = result(check(Outcome.FAIL), given=(2.5, Path("r p")))
    commands = {replay: wording.replay_command("a.json", made), run: wording.reproduction(made)}
    command = module.replay if module is replay else module.run
    seen = {}
    monkeypatch.setattr(command, "callback", lambda **given: seen.update(given))
    answer = CliRunner().invoke(main, shlex.split(commands[module])[1:])
    assert answer.exit_code == 0, answer.output
    assert (seen["spec"], seen["device_class"], seen["device_timeout"]) == (
        made.device["spec"],
        "nominal",
        2.5,
    )
