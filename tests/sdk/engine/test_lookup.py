"""Pipelines that are looked up by name, and others derived from them."""

import pytest

import floatref
from floatref import Context, InputError, StageCall
from floatref.builtin_pipelines.signal_flows import DEFAULTS
from floatref.engine import plugins as loading
from floatref.engine.plugins import Plugins

OWN = StageCall("RemoveMean", "elevation")


class Point:
    def __init__(self, name, load):
        self.name, self.load = name, load


class Deriving:
    """A plug-in whose pipeline is that of another with our answer."""

    def __init__(self, base, name):
        self._base, self._name = base, name

    @floatref.hookimpl
    def floatref_register_pipelines(self, register):
        base = floatref.pipeline(self._base)
        register(base.with_answers(name=self._name, summary="ours", temporal_finish=(OWN,)))


@pytest.fixture
def process_with(monkeypatch):
    """Return what loads plug-ins as a new process does."""

    def load(*points):
        monkeypatch.setattr(loading, "_loaded", [])
        monkeypatch.setattr(loading, "entry_points", lambda group: points)
        return loading.plugins()

    return load


@pytest.mark.parametrize("name", floatref.pipelines())
def test_a_pipeline_that_is_looked_up_answers_every_point(name):
    found = floatref.pipeline(name)
    assert found.name == name
    assert found.answers.keys() == DEFAULTS[found.architecture].keys()


def test_a_derived_pipeline_differs_where_it_says_so():
    base = floatref.pipeline("temporal-hpf")
    mine = base.with_answers(
        name="mine", summary="ours", settings={"own_m": 2.0}, temporal_finish=(OWN,)
    )
    assert {p for p in base.answers if mine.answers[p] is not base.answers[p]} == {
        "temporal_finish"
    }
    assert mine.settings == {**base.settings, "own_m": 2.0}
    assert (mine.name, mine.summary, mine.architecture) == ("mine", "ours", "temporal")
    assert base == floatref.pipeline("temporal-hpf")


def test_a_pipeline_that_leaves_a_point_to_its_architecture_says_where_to_look():
    bare = floatref.Pipeline("mine", "temporal", "ours")
    with pytest.raises(InputError, match=r"take floatref.pipeline\('mine'\)"):
        bare.stages_at(Context("temporal_finish", bare, {}, None, 0.0))


def test_a_plug_in_may_look_up_a_pipeline_while_it_registers(process_with):
    loaded = process_with(Point("vendor", lambda: Deriving("kalman-smoother", "mine")))
    assert loaded.pipelines()["mine"].channels == floatref.pipeline("kalman-smoother").channels
    assert loaded.reports == []


def test_a_plug_in_may_look_one_up_while_it_is_imported(process_with):
    found = []

    def imported():
        found.append(floatref.pipeline("temporal-basic"))
        return Deriving("temporal-basic", "mine")

    loaded = process_with(Point("vendor", imported))
    assert found[0].name == "temporal-basic"
    assert "mine" in loaded.pipelines()


def test_looking_up_one_of_ours_loads_no_plug_in(process_with, monkeypatch):
    monkeypatch.setattr(loading, "_loaded", [])
    monkeypatch.setattr(loading, "entry_points", lambda group: pytest.fail("loaded"))
    assert floatref.pipeline("temporal-basic").name == "temporal-basic"


def test_a_plug_in_may_derive_from_one_that_is_loaded_before_it(process_with):
    first = Point("first", lambda: Deriving("temporal-basic", "one"))
    second = Point("second", lambda: Deriving("one", "two"))
    assert {"one", "two"} <= process_with(first, second).pipelines().keys()
    loaded = process_with(second, first)
    assert "two" not in loaded.pipelines()
    assert loaded.reports[0].startswith("plug-in second skipped: InputError: pipeline one: unknown")


def test_an_unknown_pipeline_is_refused():
    with pytest.raises(InputError, match="pipeline mine: unknown; there are temporal-basic"):
        floatref.pipeline("mine")


def test_plug_ins_are_loaded_once(process_with):
    loads = []
    loaded = process_with(Point("vendor", lambda: loads.append(1) or Deriving("none", "x")))
    assert loading.plugins() is loaded
    assert loads == [1]
    assert isinstance(loaded, Plugins)
