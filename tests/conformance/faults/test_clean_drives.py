"""A line about a healthy drive is a false alarm, unless it states a latency that the drive has."""

from importlib import import_module
from types import SimpleNamespace

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.faults import clean_drives
from floatref_conformance.faults.clean_drives import LATENCY_MS, Alarm, try_drive
from floatref_conformance.proving_ground.scenario import Scenario

laws = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def alarms_of(monkeypatch):
    """Return what gives the alarms of a drive that one pipeline answers as told."""

    def alarms_of(latency_ms: float, answer) -> list[Alarm]:
        nothing = SimpleNamespace(recording=None)
        simulating = import_module("floatref_conformance.proving_ground.simulate")
        monkeypatch.setattr(simulating, "simulate", lambda scenario: nothing)
        monkeypatch.setattr(clean_drives, "process_with_warnings", lambda *_: answer())
        return try_drive("drive", Scenario(latency_ms=latency_ms), ("one",))

    return alarms_of


def moved(stated_ms: float, *others: str):
    """Return a profile whose left height was moved by ``stated_ms``, and its lines."""
    later_s = 1e-3 * stated_ms
    laser = {"left": {"later_s": later_s}, "right": {}}
    line = f"channel left.height: {1e3 * later_s:.2f} ± 0.10 ms later than its accelerometer"
    return SimpleNamespace(provenance={"laser": laser}), (line, *others)


@laws
@given(st.floats(0.0, 3.0), st.floats(0.0, 6.0))
def test_a_latency_is_no_alarm_exactly_where_it_is_stated_right(alarms_of, true_ms, stated_ms):
    off_ms = abs(stated_ms - true_ms)
    assume(abs(off_ms - LATENCY_MS) > 1e-9)
    assert (alarms_of(true_ms, lambda: moved(stated_ms)) == []) == (off_ms < LATENCY_MS)


def test_other_lines_and_refusals_are_alarms_whatever_the_latency(alarms_of):
    other = "channel right.height: 2.00 ± 0.10 ms later than its accelerometer"
    assert alarms_of(2.0, lambda: moved(2.0, other)) == [Alarm("drive", "one", other, False)]

    def refuse():
        raise InputError("channel distance: in feet")

    (alarm,) = alarms_of(2.0, refuse)
    assert alarm == Alarm("drive", "one", "channel distance: in feet", True)
