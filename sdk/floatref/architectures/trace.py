"""`FLOATREF_TRACE=hooks` (or 1) prints every call of a hook to standard error.

The variable holds words, separated by commas; those that are not known are ignored.
"""

import os
import sys
from collections.abc import Iterable

VARIABLE = "FLOATREF_TRACE"
HOOKS = frozenset({"hooks", "1"})


def trace_hook(plugin: str, hook: str, outcome: str) -> None:
    """Print which plug-in was asked, for what, and what came of it, if hooks are traced."""
    words = {word.strip() for word in os.environ.get(VARIABLE, "").split(",")}
    if words & HOOKS:
        print(f"hook {hook}: plug-in {plugin}: {outcome}", file=sys.stderr)


def listed(names: Iterable[str]) -> str:
    """Return ``names`` as a trace shows them."""
    return ", ".join(names) or "nothing"
