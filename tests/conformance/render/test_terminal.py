"""The terminal: what is shown while a run goes on, and after."""

import re
from dataclasses import replace
from io import StringIO

import numpy as np
import pytest
from rich.console import Console

from floatref.files import read_profile, write_profile
from floatref.values.profile import ProfileTrack
from floatref_conformance.classes import Effort
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.runner import run
from floatref_conformance.render.terminal import TerminalRenderer


def shown(plan, terminal, verbose=False):
    file = StringIO()
    renderer = TerminalRenderer(Console(file=file, force_terminal=terminal, width=150), verbose)
    run(plan, renderer.handle)
    return file.getvalue()


def test_a_terminal_gets_a_progress_bar_and_then_the_table(plan, fake_device):
    text = shown(plan(fake_device()), terminal=True)
    assert "\x1b[" in text
    assert "PASS: 1 of 1 checks that ran passed" in text


def test_a_pipe_gets_the_table_whole_with_worst_limit_and_margin(plan, fake_device):
    text = shown(plan(fake_device(lambda t: {n: 0.5 * z for n, z in t.items()})), terminal=False)
    row = next(line for line in text.splitlines() if line.startswith(" toy"))
    cells = re.fullmatch(
        r" toy +fail +no class +2 +IRI error: (\S+) m/km, limit (\S+) m/km +(\S+)%", row.rstrip()
    )
    worst, limit, margin = map(float, cells.groups())
    assert worst > limit == 0.1
    assert margin == pytest.approx(100 - 1000 * worst, abs=2)
    (summary,) = (line for line in text.splitlines() if line.endswith("[Toy 1.2]"))
    assert "limit 0.1 m/km" in summary


def test_brackets_in_a_plugins_clause_are_text(plan, fake_device, toy_check):
    made = plan(fake_device(), toy_check(clause="[red] 5"))
    assert "[red] 5" in shown(made, terminal=False, verbose=True)


def test_the_progress_bar_goes_away_after_an_error(plan, fake_device, toy_check):
    console = Console(file=StringIO(), force_terminal=True)
    renderer = TerminalRenderer(console)
    with pytest.raises(SuiteError):
        run(plan(fake_device(), toy_check(skew=1.0)), renderer.handle)
    assert len(console._live_stack) == 1
    renderer.close()
    renderer.close()
    assert console._live_stack == []


def test_what_a_device_flags_invalid_is_told_though_it_passes(plan, fake_device):
    class Doubter(fake_device):
        def run(self, recording, profile):
            super().run(recording, profile)
            made = read_profile(profile)
            tracks = tuple(
                ProfileTrack.of(t.name, np.array(t.elevation), np.zeros(t.elevation.size))
                for t in made.tracks
            )
            write_profile(replace(made, tracks=tracks), profile, overwrite=True)

    text = shown(plan(Doubter()), terminal=False, verbose=True)
    assert "PASS: 1 of 1" in text
    assert "toy: up to 60.0 m of a wheel path flagged invalid" in text
    assert "flagged" not in shown(plan(fake_device()), terminal=False, verbose=True)
    assert "flagged" not in shown(plan(Doubter()), terminal=False)


def test_a_failure_of_another_effort_is_reproduced_with_that_effort(plan, fake_device):
    bad = fake_device(lambda t: {n: 0.5 * z for n, z in t.items()})
    text = shown(plan(bad, effort=Effort.CERTIFICATION), terminal=False)
    assert text.rstrip().endswith("--seed 0 --effort certification --check toy")
    assert "--effort" not in shown(plan(bad), terminal=False).splitlines()[-1]


def test_a_check_that_is_not_applicable_says_what_it_needs(plan, fake_device, toy_check):
    needy = toy_check(id="needy", needs=frozenset({"gnss"}))
    text = shown(plan(fake_device(), toy_check(), needy), terminal=False)
    assert "needy: not applicable (needs gnss, which the device does not declare)" in text
    assert "PASS: 1 of 1" in text
