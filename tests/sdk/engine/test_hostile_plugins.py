"""A plug-in that raises what no program catches is reported; Ctrl-C alone ends the command."""

from pathlib import Path

import pytest

from floatref import answers, hookimpl
from floatref.engine.plugins import Plugins
from floatref.engine.recordings import readers
from floatref.engine.recordings.readers import find_readers, guard
from floatref.errors import PluginError
from floatref.interfaces.pipeline import Context


class Odd(BaseException):
    """No Exception: a test framework's way out, or a mistake."""


FAULTS = [SystemExit(3), Odd("odd"), GeneratorExit(), MemoryError()]


class Point:
    def __init__(self, error: BaseException) -> None:
        self.name, self._error = "cracked", error

    def load(self) -> object:
        raise self._error


class Adapter:
    name, summary = "cracked", "of a plug-in"

    def __init__(self, error: BaseException) -> None:
        self._error = error

    def recognises(self, source: Path) -> bool:
        raise self._error

    def read(self, source: Path) -> object:
        raise self._error


class Plugin:
    def __init__(self, error: BaseException) -> None:
        self._error = error

    @hookimpl
    def floatref_register_adapters(self, register):
        register(Adapter(self._error))

    @answers("temporal-basic")
    def temporal_combine(self, context):
        raise self._error


def loaded(error: BaseException) -> Plugins:
    found = Plugins()
    found.add(Plugin(error), "cracked")
    return found


@pytest.mark.parametrize("error", FAULTS)
def test_at_import_it_is_skipped(error: BaseException) -> None:
    found = Plugins()
    found.load([Point(error)])
    assert found.reports[0].startswith(f"plug-in cracked skipped: {type(error).__name__}")


@pytest.mark.parametrize("error", FAULTS)
def test_while_it_recognises_the_others_are_asked(
    error: BaseException, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    found = loaded(error)
    monkeypatch.setattr(readers, "plugins", lambda: found)
    (tmp_path / "recording.json").touch()
    assert "cracked" not in [reader.name for reader in find_readers(tmp_path)]
    assert found.reports[0].startswith(f"adapter cracked: {tmp_path}: {type(error).__name__}")


@pytest.mark.parametrize("error", FAULTS)
def test_at_a_point_the_default_answers(error: BaseException) -> None:
    found = loaded(error)
    pipeline = found.pipeline("temporal-basic")
    context = Context("temporal_combine", pipeline, pipeline.settings, None, 0.0)
    assert len(found.ask(context)) == 1
    assert type(error).__name__ in found.reports[0]


@pytest.mark.parametrize("error", FAULTS[:2])
def test_while_it_reads_it_is_one_line(error: BaseException) -> None:
    line = f"adapter cracked: run: {type(error).__name__}"
    with pytest.raises(PluginError, match=line), guard("cracked", Path("run")):
        raise error


def test_ctrl_c_still_ends_the_command(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        Plugins().load([Point(KeyboardInterrupt())])
    found = loaded(KeyboardInterrupt())
    monkeypatch.setattr(readers, "plugins", lambda: found)
    with pytest.raises(KeyboardInterrupt):
        find_readers(tmp_path)
    with pytest.raises(KeyboardInterrupt), guard("cracked", Path("run")):
        raise KeyboardInterrupt
