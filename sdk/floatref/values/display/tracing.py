"""What the environment asks to be printed while a program runs: `FLOATREF_TRACE=hooks,compile`."""

import os

VARIABLE = "FLOATREF_TRACE"


def is_traced(*words: str) -> bool:
    """Return whether one of ``words`` is in the list, divided by commas, in the environment."""
    asked = {word.strip() for word in os.environ.get(VARIABLE, "").split(",")}
    return not asked.isdisjoint(words)
