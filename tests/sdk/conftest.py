"""Adapters of tests, made known to all commands."""

from collections.abc import Callable

import pytest

from floatref import hookimpl
from floatref.architectures import plugins, processing, readers


@pytest.fixture
def know(monkeypatch: pytest.MonkeyPatch) -> Callable[[object], None]:
    """Make an adapter known, as the package of a vendor does, and no other."""

    def install(adapter: object) -> None:
        class Plugin:
            @hookimpl
            def floatref_register_adapters(self, register: Callable[[object], None]) -> None:
                register(adapter)

        loaded = plugins.Plugins()
        loaded.add(Plugin(), "logger")
        for module in (readers, processing):
            monkeypatch.setattr(module, "plugins", lambda: loaded)

    return install
