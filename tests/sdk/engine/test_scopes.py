"""An answer holds for the pipelines that it names, and goes before their own."""

from fractions import Fraction

import pytest

from floatref import (
    Axis,
    Context,
    DropOut,
    Header,
    Pipeline,
    PluginError,
    Profile,
    ProfileTrack,
    StageCall,
    answers,
    hookimpl,
    process,
)
from floatref.engine.plugins import Plugins

OWN = StageCall("RemoveMean", "elevation")
THEIRS = StageCall("FromFirst", "elevation")


def context(pipeline, point="temporal_combine"):
    header = Header(Axis.TIME, 1e-3, 0.0, Fraction(1000), frozenset(), ("main",))
    return Context(point, pipeline, pipeline.settings, header, 0.0)


def answering(*pipelines):
    """Return a plug-in that answers one point of ``pipelines``."""

    class Vendor:
        @answers(*pipelines)
        def temporal_combine(self, context):
            return (THEIRS,)

    return Vendor()


def names(loaded, pipeline):
    return [stage.name for stage in loaded.ask(context(pipeline))]


def loaded_with(*plugins):
    loaded = Plugins()
    for number, plugin in enumerate(plugins):
        loaded.add(plugin, f"vendor-{number}")
    return loaded


def test_every_pipeline_that_is_not_named_stays_as_it_is():
    loaded = loaded_with(answering("temporal-basic", "kalman-filter"))
    temporal = [p for p in loaded.pipelines().values() if p.architecture == "temporal"]
    changed = {p.name for p in temporal if names(loaded, p) != names(Plugins(), p)}
    assert changed == {"temporal-basic", "kalman-filter"}


def test_two_plug_ins_may_answer_a_point_of_different_pipelines():
    loaded = loaded_with(answering("temporal-basic"), answering("kalman-filter"))
    for name in ("temporal-basic", "kalman-filter"):
        assert names(loaded, loaded.pipeline(name)) == ["FromFirst"]


def test_the_architecture_answers_where_nobody_else_does():
    assert names(Plugins(), Pipeline("mine", "temporal", "ours")) == ["Combine"]


def test_a_pipeline_goes_before_its_architecture():
    mine = Pipeline("mine", "temporal", "ours", {}, {"temporal_combine": (OWN,)})
    assert names(loaded_with(answering("temporal-basic")), mine) == ["RemoveMean"]


def test_a_plug_in_that_names_a_pipeline_goes_before_it():
    mine = Pipeline("mine", "temporal", "ours", {}, {"temporal_combine": (OWN,)})
    assert names(loaded_with(answering("mine")), mine) == ["FromFirst"]


def test_an_answer_can_add_to_that_of_the_pipeline():
    class Adding:
        @answers("temporal-basic")
        def temporal_combine(self, context):
            return (*context.pipeline.stages_at(context), THEIRS)

    loaded = loaded_with(Adding())
    assert names(loaded, loaded.pipeline("temporal-basic")) == ["Combine", "FromFirst"]


@pytest.mark.parametrize("mark", [hookimpl, hookimpl(wrapper=True), hookimpl(tryfirst=True)])
def test_a_plug_in_that_names_no_pipeline_is_left_out_and_told_what_to_write(mark):
    def temporal_combine(self, context):
        yield from (THEIRS,)

    vendor = type("Vendor", (), {"temporal_combine": mark(temporal_combine)})()
    loaded = loaded_with(vendor)
    assert names(loaded, loaded.pipeline("temporal-basic")) == ["Combine"]
    (line,) = loaded.reports
    assert line.startswith("plug-in vendor-0 skipped: PluginError: temporal_combine names no")
    assert "@floatref.answers(" in line


def test_a_fall_back_that_names_no_pipeline_is_left_out():
    class Vendor:
        @hookimpl
        def temporal_fall_back(self, context):
            return context.profile

    assert "temporal_fall_back names no pipeline" in loaded_with(Vendor()).reports[0]


def test_a_fall_back_is_asked_for_the_pipelines_that_it_names():
    class Vendor:
        @answers("kalman-filter")
        def temporal_fall_back(self, context):
            return context.profile

    loaded = loaded_with(Vendor())
    for name, taken in (("kalman-filter", True), ("temporal-basic", False)):
        profile = Profile(0.1, (ProfileTrack.of("main", [0.0, 0.0]),), pipeline=name)
        asked = DropOut(Pipeline, profile, {}, process)
        assert (loaded.fall_back(asked) is profile) == taken


@pytest.mark.parametrize(
    ("named", "message"),
    [("temporal-basik", "which is unknown"), ("spatial-basic", "which is spatial and has no such")],
)
def test_a_name_that_has_no_such_point_is_reported_once(named, message):
    loaded = loaded_with(answering("temporal-basic", named))
    for _ in range(2):
        loaded.pipeline("temporal-basic")
    (line,) = loaded.reports
    assert f"vendor-0: temporal_combine names pipeline {named}, {message}" in line


@pytest.mark.parametrize("wrong", [[], [None], [lambda self, context: None]])
def test_answers_has_to_be_given_names(wrong):
    with pytest.raises(TypeError, match='write @answers\\("temporal-basic"\\)'):
        answers(*wrong)


def test_two_answers_name_the_pipeline():
    loaded = loaded_with(answering("temporal-basic"), answering("temporal-basic"))
    with pytest.raises(PluginError, match="vendor-0 and vendor-1 both answer temporal_combine of"):
        names(loaded, loaded.pipeline("temporal-basic"))
