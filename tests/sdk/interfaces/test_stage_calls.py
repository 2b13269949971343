"""Registered stages: all of ours are, and a call makes one from settings."""

import importlib
import pkgutil
import sys
from inspect import isabstract

import pytest

import floatref
from floatref import Context, InputError, Pipeline, PluginError, Setting, Stage, StageCall
from floatref.builtin_pipelines.registered_stages import STAGES
from floatref.engine.plugins import Plugins


def concrete(kind=Stage):
    """Yield the stages of the SDK that no other derives from, and bases that are stages."""
    for found in kind.__subclasses__():
        yield from concrete(found)
        if found.__module__.startswith("floatref.") and not isabstract(found):
            yield found


def test_every_stage_of_the_sdk_is_registered():
    for module in pkgutil.walk_packages(floatref.__path__, "floatref."):
        if ".stages" in module.name:
            importlib.import_module(module.name)
    bases = {base for kind in STAGES for base in kind.__mro__[1:]} - set(STAGES)
    assert set(concrete()) - bases == set(STAGES)
    assert {kind.__name__: kind for kind in STAGES} == Plugins().stages()


def asked(settings=None, **answers):
    pipeline = Pipeline("mine", "temporal", "ours", settings or {}, answers)
    return Plugins().ask(Context("temporal_finish", pipeline, pipeline.settings, None, 0.0))


def test_a_call_makes_a_new_stage_for_each_run():
    calls = (StageCall("HighPassB3S1", "elevation", cutoff=0.1),)
    (one,), (two,) = asked(temporal_finish=calls), asked(temporal_finish=calls)
    assert one is not two
    assert (one.channel, one.cutoff) == (two.channel, two.cutoff) == ("elevation", 0.1)


@pytest.mark.parametrize("number", [0.01, 0.02])
def test_a_setting_is_that_of_the_run(number):
    calls = (StageCall("HighPassB3S1", "elevation", cutoff=Setting("per_m")),)
    (stage,) = asked({"per_m": number}, temporal_finish=calls)
    assert stage.cutoff == number


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (StageCall("HighPasB3S1", "elevation", 0.1), "unknown; did you mean HighPassB3S1"),
        (StageCall("HighPassB3S1", "elevation"), "missing a required argument: 'cutoff'"),
        (StageCall("HighPassB3S1", "elevation", cut=1), r"it takes \(channel: str, cutoff"),
        (StageCall("HighPassB3S1", "elevation", Setting("per_m")), "setting per_m: "),
    ],
)
def test_a_call_that_cannot_be_made_names_pipeline_and_point(call, message):
    with pytest.raises(PluginError, match=f"pipeline mine: temporal_finish: .*{message}"):
        asked(temporal_finish=(call,))


@pytest.mark.parametrize(
    ("kind", "message"),
    [
        (lambda: 7, "made int, which is not a Stage"),
        (lambda: 1 / 0, "ZeroDivisionError: division"),
        (lambda: sys.exit(3), "SystemExit: 3"),
    ],
)
def test_a_class_that_makes_no_stage_is_named(kind, message):
    with pytest.raises(PluginError, match=f"stage Odd: {message}"):
        StageCall("Odd").make({"Odd": kind}, float)


def test_an_answer_that_would_end_the_program_names_pipeline_and_point():
    with pytest.raises(PluginError, match="pipeline mine: temporal_finish: SystemExit: 3"):
        asked(temporal_finish=lambda context: sys.exit(3))


def test_a_function_may_mix_stages_and_calls():
    ours = floatref.make_stage("Combine")
    first, second = asked(temporal_finish=lambda context: [StageCall("Seams"), ours])
    assert first.name == "Seams"
    assert second is ours


def test_a_stage_in_place_of_a_call_is_refused_when_it_registers():
    class Vendor:
        @floatref.hookimpl
        def floatref_register_pipelines(self, register):
            answers = {"temporal_finish": (floatref.make_stage("Combine"),)}
            register(Pipeline("mine", "temporal", "ours", {}, answers))

    loaded = Plugins()
    loaded.add(Vendor(), "vendor")
    assert "mine" not in loaded.pipelines()
    assert "temporal_finish: give StageCalls, or a function" in loaded.reports[0]


def test_stages_are_made_by_name():
    assert set(floatref.stage_names()) >= {kind.__name__ for kind in STAGES}
    stage = floatref.make_stage("KalmanSmoother", None, noise=None, wavelength_m=50.0)
    assert stage.wavelength_m == 50.0
    for name, arguments in (("Smother", ()), ("Integrate", ()), ("FromFirst", (Setting("x"),))):
        with pytest.raises(InputError):
            floatref.make_stage(name, *arguments)
