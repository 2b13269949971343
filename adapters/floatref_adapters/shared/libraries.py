"""Libraries of the extra `adapters`, imported when they are needed and not before."""

from importlib import import_module
from typing import Any

from floatref import InputError


def library(name: str, task: str) -> Any:
    """Return the module ``name``; InputError, saying that ``task`` needs it, if it is missing."""
    try:
        return import_module(name)
    except ImportError as error:
        package = name.split(".")[0]
        raise InputError(f"{task} needs {package}; install floatref[adapters]") from error
