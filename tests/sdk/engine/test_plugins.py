"""Plug-ins are asked one by one: who answers, who clashes, who is broken."""

import pytest

from floatref import answers, hookimpl
from floatref.engine.plugins import Plugins
from floatref.errors import PluginError
from floatref.interfaces import hookspecs
from floatref.interfaces.pipeline import Context, Pipeline
from floatref.stages.integration import Combine, RemoveMean

HOOKS = [
    name for name in vars(hookspecs) if name.startswith(("floatref_", "temporal_", "spatial_"))
]


class Answering:
    def __init__(self, *stages):
        self._stages = stages

    @answers("temporal-basic")
    def temporal_combine(self, context):
        return self._stages or None


class Broken:
    @answers("temporal-basic")
    def temporal_combine(self, context):
        raise ZeroDivisionError("by a plug-in")


class Registering:
    def __init__(self, name):
        self._name = name

    @hookimpl
    def floatref_register_pipelines(self, register):
        register(Pipeline(self._name, "temporal", "of a plug-in"))


class Point:
    def __init__(self, name, plugin):
        self.name, self._plugin = name, plugin

    def load(self):
        if isinstance(self._plugin, BaseException):
            raise self._plugin
        return self._plugin


@pytest.fixture
def context():
    pipeline = Plugins().pipeline("temporal-basic")
    return Context("temporal_combine", pipeline, pipeline.settings, None, 0.0)


def test_one_third_party_replaces_the_default(context):
    loaded = Plugins()
    mine = RemoveMean("elevation")
    loaded.add(Answering(mine), "vendor")
    loaded.add(Answering(), "silent")
    assert list(loaded.ask(context)) == [mine]


def test_a_raising_plugin_is_reported_and_the_default_answers(context):
    loaded = Plugins()
    loaded.add(Broken(), "cracked")
    (stage,) = loaded.ask(context)
    assert isinstance(stage, Combine)
    assert loaded.reports == ["plug-in cracked skipped: ZeroDivisionError: by a plug-in"]


def test_one_broken_entry_point_does_not_hide_the_others():
    loaded = Plugins()
    loaded.load([Point("cracked", ImportError("no\nmodule")), Point("whole", Registering("mine"))])
    assert "mine" in loaded.pipelines()
    assert loaded.reports == ["plug-in cracked skipped: ImportError: no module"]


def test_a_plugin_with_a_wrong_argument_is_reported():
    class Misfit:
        @answers("temporal-basic")
        def temporal_combine(self, context, colour):
            return None

    loaded = Plugins()
    loaded.add(Misfit(), "misfit")
    (line,) = loaded.reports
    assert "plug-in misfit skipped" in line
    assert "colour" in line


@pytest.mark.parametrize("error", [SystemExit(3), ImportError("no module"), ValueError("x")])
def test_a_plugin_cannot_end_the_program(error):
    loaded = Plugins()
    loaded.load([Point("cracked", error)])
    assert type(error).__name__ in loaded.reports[0]


@pytest.mark.parametrize("name", ["floatref", "vendor"])
def test_a_name_that_is_taken_removes_nobody(name):
    loaded = Plugins()
    loaded.add(Registering("first"), "vendor")
    loaded.add(Registering("second"), name)
    assert {"temporal-basic", "first"} <= set(loaded.pipelines())
    assert loaded.reports == [f"plug-in {name} skipped: ValueError: another plug-in has this name"]


def format_with(suffix, name="mine"):
    methods = {method: lambda *args: None for method in ("recognises", "read", "write")}
    return type("Mine", (), {**methods, "suffix": suffix, "name": name, "summary": "ours"})()


@pytest.mark.parametrize(
    ("hook", "item", "message"),
    [
        ("pipelines", ["temporal"], "str is not a Pipeline"),
        ("pipelines", [Pipeline("x", "hybrid", "of a plug-in")], "no architecture 'hybrid'"),
        ("pipelines", [Pipeline("x", "temporal", None)], "needs a name and a summary"),
        (
            "pipelines",
            [Pipeline("x", "temporal", "", {}, {"temporal_finnish": None})],
            "no point 'temporal_finnish'",
        ),
        ("adapters", [object()], "object has no method recognises"),
        ("stages", [7, object], "7 is not the name"),
        ("profile_formats", [object()], "object has no method recognises"),
        ("profile_formats", [format_with("erd")], "suffix 'erd' is not a point and small letters"),
        ("profile_formats", [format_with("")], "suffix '' is not a point"),
        ("profile_formats", [format_with(".mine", None)], "needs a name and a summary"),
    ],
)
def test_what_cannot_work_is_left_out_when_it_registers(hook, item, message):
    def registering(register):
        register(*item)

    loaded = Plugins()
    namespace = {f"floatref_register_{hook}": staticmethod(hookimpl(registering))}
    loaded.add(type("Vendor", (), namespace)(), "vendor")
    assert all((loaded.pipelines(), loaded.adapters(), loaded.stages(), loaded.profile_formats()))
    (line,) = loaded.reports
    assert message in line


@pytest.mark.parametrize("answer", ["text", 7, (1, 2)])
def test_an_answer_that_is_no_stages_is_named(context, answer):
    class Odd:
        @answers("temporal-basic")
        def temporal_combine(self, context):
            return answer

    loaded = Plugins()
    loaded.add(Odd(), "odd")
    with pytest.raises(PluginError, match="plug-in odd: answered temporal_combine with"):
        loaded.ask(context)


def test_a_pipeline_whose_answer_raises_is_named(context):
    def broken(context):
        raise ZeroDivisionError("of a pipeline")

    answers = {"temporal_combine": broken}
    pipeline = Pipeline("mine", "temporal", "of a plug-in", {}, answers)
    with pytest.raises(PluginError, match="pipeline mine: temporal_combine: ZeroDivisionError: of"):
        Plugins().ask(Context("temporal_combine", pipeline, {}, None, 0.0))


def test_the_same_name_twice_stops_with_both_names():
    loaded = Plugins()
    loaded.add(Registering("temporal-basic"), "vendor")
    with pytest.raises(PluginError, match=r"both register temporal-basic; remove one"):
        loaded.pipelines()


@pytest.mark.parametrize("hook", HOOKS)
def test_every_hook_says_what_it_is_for(hook):
    assert len(getattr(hookspecs, hook).__doc__) > 20
