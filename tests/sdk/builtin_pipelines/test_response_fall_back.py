"""A laser that drops out, on vehicles whose response is recorded."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from floatref import answers
from floatref.engine import run as engine
from floatref.engine.plugins import Plugins, plugins
from floatref.engine.run import Result, run
from floatref.errors import InputError, PluginError
from floatref.interfaces.drop_out import DropOut
from floatref.measures import high_pass
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate

BEGIN_M, END_M = 150.0, 160.0


@pytest.fixture(scope="module")
def drive() -> Simulation:
    return simulate(
        Scenario(
            seed=4,
            length_m=320.0,
            imu=False,
            gnss=False,
            rate_hz=4000.0,
            profile_interval_m=0.025,
            tracks=("left",),
        )
    )


def dropped(recording: Recording) -> Recording:
    distance = recording.channel("distance").values
    gone = (distance > BEGIN_M) & (distance < END_M)
    channels = [
        Channel(c.id, np.where(gone, np.nan, c.values), c.clock) if c.id.name == "height" else c
        for c in recording.channels
    ]
    return replace(recording, channels=tuple(channels))


def without_response(recording: Recording) -> Recording:
    nominal = ("vertical_specific_force", "height", "distance")
    return replace(recording, channels=tuple(c for c in recording.channels if c.id.name in nominal))


def errors(made: Simulation, profile: Profile) -> FloatArray:
    true = high_pass(made.truth.tracks[0].elevation, made.truth.interval_m)
    found = profile.tracks[0].elevation
    size = min(true.size, found.size)
    return found[:size] - true[:size]


def rms(made: Simulation, result: Result, begin_m: float, end_m: float) -> float:
    inside = slice(round(begin_m / 0.025), round(end_m / 0.025))
    return float(np.sqrt(np.mean(errors(made, result.profile)[inside] ** 2)))


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", ["temporal-basic", "temporal-adaptive-hpf-spatial-backward"])
def test_the_response_takes_the_place_of_a_line(drive: Simulation, pipeline: str) -> None:
    recording = dropped(drive.recording)
    bridged = run(recording, pipeline)
    alone = run(without_response(recording), pipeline)
    assert rms(drive, bridged, BEGIN_M, END_M) < 0.5 * rms(drive, alone, BEGIN_M, END_M)
    assert rms(drive, bridged, BEGIN_M, END_M) < 2 * rms(drive, bridged, 100.0, 140.0)
    (line,) = [line for line in bridged.warnings if "elevation" in line]
    assert "over 10 m" in line
    assert "response-joint-input-state" in line
    points = round(np.array(BEGIN_M) / 0.025) + 1, round(np.array(END_M) / 0.025) - 1
    assert not bridged.profile.tracks[0].valid[slice(*points)].any()


def test_a_run_without_gaps_is_left_bit_by_bit(drive: Simulation) -> None:
    whole = run(drive.recording, "temporal-basic")
    alone = run(without_response(drive.recording), "temporal-basic")
    np.testing.assert_array_equal(
        whole.profile.tracks[0].elevation, alone.profile.tracks[0].elevation
    )
    assert whole.warnings == alone.warnings


def test_an_unknown_vehicle_is_told_and_the_line_stays(drive: Simulation) -> None:
    recording = dropped(drive.recording)
    result = run(unknown_vehicle(recording), "temporal-basic")
    alone = run(without_response(recording), "temporal-basic")
    np.testing.assert_array_equal(
        result.profile.tracks[0].elevation, alone.profile.tracks[0].elevation
    )
    (line,) = [line for line in result.warnings if "bridged by straight lines only" in line]
    assert "setup.vehicle" in line


class Other:
    def __init__(self, answer: object) -> None:
        self.answer = answer

    @answers("temporal-basic")
    def temporal_fall_back(self, context: DropOut) -> object:
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


def drop_out_of(recording: Recording, drive: Simulation) -> DropOut:
    def process(pipeline: str, settings: Mapping[str, object] | None = None) -> Profile:
        return run(recording, pipeline, settings).profile

    profile = replace(drive.truth, pipeline="temporal-basic")
    return DropOut(recording, profile, {"left": np.array([[BEGIN_M, END_M]])}, process)


def unknown_vehicle(recording: Recording) -> Recording:
    return replace(recording, setup=replace(recording.setup, vehicle=None))


def test_ours_is_not_asked_where_another_answers(drive: Simulation) -> None:
    drop_out = drop_out_of(unknown_vehicle(drive.recording), drive)
    loaded = Plugins()
    loaded.add(Other(drive.truth), "other")
    assert loaded.fall_back(drop_out) is drive.truth


def test_two_plug_ins_that_answer_are_named(drive: Simulation) -> None:
    loaded = Plugins()
    loaded.add(Other(drive.truth), "one")
    loaded.add(Other(drive.truth), "two")
    with pytest.raises(PluginError, match=r"plug-ins one and two both answer"):
        loaded.fall_back(drop_out_of(without_response(drive.recording), drive))


def test_what_is_no_profile_is_refused_with_the_name(drive: Simulation) -> None:
    loaded = Plugins()
    loaded.add(Other("elevation"), "other")
    with pytest.raises(PluginError, match="other: answered temporal_fall_back with str"):
        loaded.fall_back(drop_out_of(without_response(drive.recording), drive))


def test_a_broken_plug_in_is_reported_and_ours_answers(drive: Simulation) -> None:
    loaded = Plugins()
    loaded.add(Other(ValueError("broken")), "other")
    assert loaded.fall_back(drop_out_of(without_response(drive.recording), drive)) is None
    assert any("other skipped" in line for line in loaded.reports)


def test_what_makes_the_estimate_impossible_is_raised(drive: Simulation) -> None:
    drop_out = drop_out_of(unknown_vehicle(dropped(drive.recording)), drive)
    with pytest.raises(InputError, match=r"setup\.vehicle"):
        plugins().fall_back(drop_out)


class Same:
    """A plug-in that runs a temporal pipeline again, which has the same gaps."""

    def __init__(self) -> None:
        self.asked: list[DropOut] = []

    @answers("temporal-basic")
    def temporal_fall_back(self, context: DropOut) -> Profile:
        self.asked.append(context)
        return context.process("temporal-hpf")


def test_a_pipeline_that_a_fall_back_runs_asks_for_no_other(
    drive: Simulation, monkeypatch: pytest.MonkeyPatch
) -> None:
    loaded, same = Plugins(), Same()
    loaded.add(same, "same")
    monkeypatch.setattr(engine, "plugins", lambda: loaded)
    result = run(dropped(drive.recording), "temporal-basic")
    assert len(same.asked) == 1
    assert any("temporal-hpf gives the elevation" in line for line in result.warnings)
