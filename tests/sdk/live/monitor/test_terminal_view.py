"""The view in a terminal fits 80 columns, shows the values, and never holds up the run."""

import io
from dataclasses import replace
from threading import Event, Thread

import numpy as np
import pytest
from rich.console import Console

from floatref.live.bounds import Latency
from floatref.live.monitor import terminal_view as view
from floatref.live.monitor.sections import Section, TrackFigures
from floatref.live.monitor.sensor_health import Health, SensorState
from floatref.live.monitor.shown_state import Event as Line
from floatref.live.monitor.shown_state import Shown, Status, ToFinal
from floatref.live.monitor.state_tables import plain_line, render

COLUMNS = 80
WAIT_S = 60.0
ESCAPE = "\x1b[2J"


def section(start_m, is_final, is_running=False, iri=1.234, sigma=0.0567, share=0.987):
    tracks = tuple(TrackFigures(n, iri, sigma, share) for n in ("left", "right"))
    return Section(start_m, 160.9, tracks, is_final, is_running)


def sensor(name, health, dropped=0):
    return SensorState(name, health, 123_456_789, 1234, 0.87, dropped, 3, 3.25, 12.0)


SENSORS = (
    sensor("left.vertical_specific_force", Health.OK),
    sensor("right.vertical_specific_force", Health.STUCK, 120),
    sensor("left.height", Health.MISSING),
    sensor("distance", Health.SILENT),
)
SHOWN = Shown(
    name="run",
    status=Status.RUNNING,
    reason="",
    pipeline="kalman-smoother-constant-height-attitude",
    for_s=3725.0,
    calculates_s=None,
    distance_m=123_456.7,
    speed_mps=20.0,
    final_m=121_000.0,
    to_final=ToFinal(121_000.1, 1432.4, Latency(2382.4, 66.8, 35.5, 350.5, 5.5)),
    sensors=SENSORS,
    sections=(
        *(section(160.9 * k, True) for k in range(20)),
        section(160.9 * 20, False, sigma=np.nan),
    ),
    running=section(160.9 * 21, False, True, np.nan, np.nan, 0.0),
    events=(Line(1, "channel left.height: 120 samples were not sent " + ESCAPE, 12.0),),
    fault="",
)


def drawn(shown, columns=COLUMNS):
    stream = io.StringIO()
    Console(file=stream, width=columns, force_terminal=False, emoji=False).print(render(shown))
    return stream.getvalue()


def test_80_columns_hold_every_value():
    text = drawn(SHOWN)
    assert max(map(len, text.splitlines())) <= COLUMNS
    assert "…" not in text
    for value in (
        "62:05 min  kalman-smoother-constant-height-attitude",
        "speed 72.0 km/h   distance 123456.7 m   final to 121000.0 m",
        "next final point in 1432 m and 66.8 s; at a standstill after 35.5 s",
        "samples dropped 120   late 12",
        "stuck for 12 s",
        "87 % missing",
        "silent for 3 s",
        "right.vertical_specific_force",
        "1.234 ± 0.057, 98 %",
        "provisional, 161 m",
        "at 12 m: channel left.height: 120 samples were not sent",
    ):
        assert value in text
    right = next(line for line in text.splitlines() if "right.vertical" in line)
    assert right.split()[-5:] == ["123", "M", "1234", "120", "3"]


def test_final_and_provisional_sections_are_marked_newest_first():
    rows = [line.split() for line in drawn(SHOWN).splitlines() if " final " in f"{line} "]
    rows = [row for row in rows if row[0][0].isdigit()]
    assert [row[1] for row in rows] == ["final"] * 8
    starts = [float(row[0]) for row in rows]
    assert starts == sorted(starts, reverse=True)
    assert starts[0] == pytest.approx(160.9 * 19, abs=0.06)
    lines = [line for line in drawn(SHOWN).splitlines() if "provisional" in line]
    assert [" m " in line for line in lines] == [True, False]
    assert "–, 0 %" in lines[0]
    assert "±" not in lines[1]


def test_nothing_known_is_shown_as_such():
    empty = replace(
        SHOWN,
        status=Status.WAITING,
        distance_m=None,
        speed_mps=None,
        final_m=None,
        to_final=None,
        sensors=(),
        sections=(),
        running=None,
    )
    assert "speed – km/h   distance – m   final to – m" in drawn(empty)
    assert "next final point –" in drawn(empty)
    assert plain_line(empty).startswith("run waiting, – km/h, – m, final to – m, 0 samples dropped")


def test_what_another_program_sends_moves_no_cursor():
    hostile = replace(SHOWN, name=ESCAPE, reason=ESCAPE, fault="")
    assert "\x1b" not in drawn(hostile) + plain_line(hostile)
    assert "\\x1b" in drawn(hostile)


def test_the_plain_line_names_what_is_wrong():
    line = plain_line(replace(SHOWN, calculates_s=7.0, fault="KeyError: 'x'"))
    assert "\n" not in line
    for part in (
        "run running, calculates for 7 s, 72.0 km/h",
        "IRI left 1.234 ± 0.057, 98 % m/km",
        "right.vertical_specific_force stuck for 12 s",
        "the display has failed: KeyError",
    ):
        assert part in line
    assert "left.vertical_specific_force" not in line


def test_without_a_terminal_there_is_a_line_every_so_often_and_one_at_the_end(monkeypatch):
    stream, seen = io.StringIO(), Event()
    monkeypatch.setattr(view, "LINE_S", 0.01)
    write, stream.write = stream.write, lambda text: (write(text), seen.set())[0]
    with view.terminal_view(lambda: SHOWN, stream):
        assert seen.wait(60.0)
    lines = stream.getvalue().splitlines()
    assert len(lines) >= 2
    assert set(lines) == {plain_line(SHOWN)}


def test_a_reader_that_has_gone_ends_the_view_alone():
    class Gone(io.StringIO):
        def flush(self):
            raise BrokenPipeError

    with view.terminal_view(lambda: SHOWN, Gone()):
        pass


def test_a_terminal_that_takes_no_output_holds_up_no_run(monkeypatch):
    monkeypatch.setattr(view, "ENDING_S", 0.05)
    stuck, go = Event(), Event()

    class Terminal(io.StringIO):
        def isatty(self):
            return True

        def write(self, text):
            stuck.set()
            go.wait(WAIT_S)
            return len(text)

    def use():
        with view.terminal_view(lambda: SHOWN, Terminal()):
            stuck.wait(WAIT_S)

    run = Thread(target=use, daemon=True)
    run.start()
    run.join(WAIT_S)
    ended = not run.is_alive()
    go.set()
    assert stuck.is_set()
    assert ended


def test_a_terminal_shows_the_last_state():
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    terminal, states = Terminal(), [SHOWN]
    with view.terminal_view(lambda: states[-1], terminal):
        states.append(replace(SHOWN, status=Status.COMPLETE))
    assert "complete" in terminal.getvalue()
