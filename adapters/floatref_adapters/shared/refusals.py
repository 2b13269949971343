"""What an adapter refuses, in one line: a library that is missing, or what is wrong with a file."""

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from floatref import InputError, missing_extra


@contextmanager
def prefix_errors(where: object) -> Iterator[None]:
    """Put ``where: `` before the text of any InputError raised inside, unless it is there."""
    try:
        yield
    except InputError as error:
        if str(error).startswith(str(InputError(f"{where}: "))):
            raise
        raise InputError(f"{where}: {error}") from error


def library(name: str, task: str) -> Any:
    """Return the module ``name``; InputError, saying that ``task`` needs it, if it is missing."""
    try:
        return import_module(name)
    except ImportError as error:
        package = name.split(".")[0]
        raise missing_extra(f"{task} needs {package}", "adapters") from error
