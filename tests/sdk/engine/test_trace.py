"""`FLOATREF_TRACE` prints who is asked and what is answered."""

import pytest

from floatref import Context, Pipeline, StageCall, answers, hookimpl
from floatref.engine.plugins import Plugins


class Vendor:
    @answers("temporal-basic", "temporal-mean-removal")
    def temporal_combine(self, context):
        if context.pipeline.name == "temporal-mean-removal":
            return None
        return StageCall("Combine"), StageCall("FromFirst", "elevation")

    @hookimpl
    def floatref_register_pipelines(self, register):
        register(Pipeline("mine", "temporal", "ours"))


def ask(name):
    loaded = Plugins()
    loaded.add(Vendor(), "vendor")
    pipeline = loaded.pipeline(name)
    loaded.ask(Context("temporal_combine", pipeline, pipeline.settings, None, 0.0))


@pytest.mark.parametrize("value", ["hooks", "1", "other, hooks", "hooks,other"])
def test_each_call_of_a_hook_is_a_line_on_standard_error(monkeypatch, capsys, value):
    monkeypatch.setenv("FLOATREF_TRACE", value)
    ask("temporal-basic")
    out, err = capsys.readouterr()
    assert out == ""
    lines = err.splitlines()
    assert "hook floatref_register_pipelines: plug-in vendor: registered mine" in lines
    assert lines[-1] == (
        "hook temporal_combine of temporal-basic: plug-in vendor: Combine, FromFirst"
    )


@pytest.mark.parametrize(
    ("pipeline", "outcome"),
    [
        ("temporal-mean-removal", "no answer"),
        ("kalman-smoother", "not asked, it names temporal-basic, temporal-mean-removal"),
    ],
)
def test_who_leaves_a_point_to_others_is_shown(monkeypatch, capsys, pipeline, outcome):
    monkeypatch.setenv("FLOATREF_TRACE", "hooks")
    ask(pipeline)
    vendor, ours = capsys.readouterr().err.splitlines()[-2:]
    assert vendor == f"hook temporal_combine of {pipeline}: plug-in vendor: {outcome}"
    assert ours.startswith(f"hook temporal_combine of {pipeline}: plug-in floatref: ")
    assert "Combine" in ours


@pytest.mark.parametrize("value", [None, "", "0", "other", "hook"])
def test_nothing_is_printed_unless_it_is_asked_for(monkeypatch, capsys, value):
    monkeypatch.delenv("FLOATREF_TRACE", raising=False)
    if value is not None:
        monkeypatch.setenv("FLOATREF_TRACE", value)
    ask("temporal-basic")
    assert capsys.readouterr() == ("", "")
