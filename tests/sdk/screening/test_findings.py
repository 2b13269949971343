"""What is found out about a recording is found out once, whoever needs it."""

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import cache, wraps
from typing import Any

import numpy as np
import pytest

from floatref.engine import run
from floatref.intake.blocks import Source
from floatref.screening import findings, imu_and_gnss, plausibility
from floatref.screening.findings import Screening
from floatref.screening.travel import Travel
from floatref.values.needs import Needs
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate

TRACKS = ("left", "right")
PER_RUN = ("gnss_faults", "check_readings", "check_epoch", "delay", "check_antenna", "check_course")
PER_TRACK = ("check_alive", "check_travel_force", "check_curves", "check_rates", "check_velocity")


@cache
def driven(**more: Any) -> Recording:
    scenario = {"length_m": 120.0, "speed_kmh": 60.0, "rate_hz": 1000.0, "seed": 3, **more}
    return simulate(Scenario.from_dict(scenario)).recording


def dropped(recording: Recording) -> Recording:
    channels = list(recording.channels)
    for at, channel in enumerate(channels):
        if channel.id.name == "height":
            values = channel.values.copy()
            values[3000:3200] = np.nan
            channels[at] = Channel(channel.id, values, channel.clock)
    return replace(recording, channels=tuple(channels))


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    counts: Counter[str] = Counter()

    def counted(owner: object, name: str, label: str) -> None:
        original: Callable[..., Any] = getattr(owner, name)

        @wraps(original)
        def call(*args: Any, **named: Any) -> Any:
            counts[label] += 1
            return original(*args, **named)

        monkeypatch.setattr(owner, name, call)

    counted(findings, "gnss_faults", "gnss_faults")
    for name in (*PER_RUN[1:], *PER_TRACK, "check_plausible_rates"):
        counted(imu_and_gnss, name, name)
    counted(imu_and_gnss.Motion, "of", "Motion.of")
    counted(Travel, "of", "Travel.of")
    counted(plausibility, "_examine", "examined")
    return counts


def test_a_run_finds_out_everything_once(calls: Counter[str]) -> None:
    run.run(driven(), "kalman-smoother")
    assert {name: calls[name] for name in PER_RUN} == dict.fromkeys(PER_RUN, 1)
    assert {name: calls[name] for name in PER_TRACK} == dict.fromkeys(PER_TRACK, len(TRACKS))
    assert calls["Motion.of"] == len(TRACKS)
    assert calls["check_plausible_rates"] == calls["Travel.of"] == 1
    assert calls["examined"] == 1 + 2 * len(TRACKS)


def test_a_nominal_run_asks_nothing_of_the_imu(calls: Counter[str]) -> None:
    run.run(driven(), "temporal-basic")
    assert calls == {"gnss_faults": 1, "Travel.of": 1, "examined": 1 + 2 * len(TRACKS)}


def test_the_next_run_of_a_recording_computes_nothing_again(calls: Counter[str]) -> None:
    first = run.run(driven(), "kalman-smoother")
    before = calls.copy()
    again = run.run(driven(), "kalman-smoother", known=first.screening)
    assert calls == before
    assert again.warnings == first.warnings
    for one, other in zip(first.profile.tracks, again.profile.tracks, strict=True):
        np.testing.assert_array_equal(one.elevation, other.elevation)


def test_a_fall_back_examines_what_is_new_to_it(calls: Counter[str]) -> None:
    result = run.run(dropped(driven()), "temporal-basic")
    assert sum("response-joint-input-state" in line for line in result.warnings) == len(TRACKS)
    assert calls["gnss_faults"] == calls["Travel.of"] == 1
    # The distance once; force and height of the wheel path; of its response, three channels.
    assert calls["examined"] == 1 + 2 * len(TRACKS) + 3 * len(TRACKS)


def test_what_another_recording_showed_is_not_taken_for_this_one() -> None:
    other = Screening.of(driven(seed=4))
    found = Screening.of(driven(), known=other)
    assert found.facts is not other.facts
    np.testing.assert_array_equal(found.travel.speed_mps, Travel.of(driven()).speed_mps)


def test_another_pipeline_has_cautions_of_its_own() -> None:
    recording = dropped(driven())
    nominal = Screening.of(recording)
    response = Needs(TRACKS, "unsprung_specific_force", ())
    assert sum("height" in line for line in nominal.cautions) == len(TRACKS)
    assert Screening.of(recording, response, known=nominal).cautions == ()
    assert Screening.of(recording, known=nominal) is nominal


def test_no_line_is_given_twice(calls: Counter[str]) -> None:
    setup = replace(driven().setup, gnss_antenna_offset_m=(0.0, 0.0, 0.0))
    lines = run.run(replace(driven(), setup=setup), "kalman-smoother").warnings
    assert sum("setup.gnss_antenna_offset_m" in line for line in lines) == 1
    assert len(lines) == len(set(lines))


def test_the_source_takes_what_was_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    found = Screening.of(driven())
    expected = Travel.of(driven()).fastest_mps
    assert found.gnss_faults.size == 0
    assert found.travel.fastest_mps == expected
    monkeypatch.setattr(findings, "gnss_faults", None)
    monkeypatch.setattr(Travel, "of", None)
    assert Source(found).fastest_mps == expected
