"""What is wrong, with the name of what it is wrong with before it."""

from collections.abc import Iterator
from contextlib import contextmanager

from floatref import InputError


@contextmanager
def naming(where: object) -> Iterator[None]:
    """Put ``where: `` before the text of any InputError raised inside."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{where}: {error}") from error


__all__ = ["naming"]
