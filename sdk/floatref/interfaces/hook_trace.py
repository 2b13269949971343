"""Which plug-in was called for which hook, printed where the environment asks for it."""

import sys
from collections.abc import Iterable

from floatref.values.display.tracing import is_traced

HOOKS = "hooks", "1"


def trace_hook(plugin: str, hook: str, outcome: str) -> None:
    """Print which plug-in was called, for which hook, and the outcome, if hooks are traced."""
    if is_traced(*HOOKS):
        print(f"hook {hook}: plug-in {plugin}: {outcome}", file=sys.stderr)


def list_names(names: Iterable[str]) -> str:
    """Return ``names`` as one text for a trace."""
    return ", ".join(names) or "nothing"
