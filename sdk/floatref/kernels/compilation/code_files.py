"""Machine code of a kernel in numba's cache: files of its own for each signature.

numba numbers the code of a kernel, and keeps the numbers in one index. Two processes that compile
it at the same time for two signatures take the same number, and from then on the index may name
code for the other one: every later process fails with it, until someone removes the cache. Here
each signature has an index of its own, so that two processes can only write the same thing.
"""

from collections.abc import Hashable
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from pickle import UnpicklingError
from typing import Any

DAMAGED = (
    AttributeError, EOFError, ImportError, IndexError, KeyError, TypeError, UnpicklingError,
    ValueError,
)  # fmt: skip
"""What the reading of a file raises that was not written to its end."""


class CodeFiles:
    """Takes the place of numba's file of an index.

    What cannot be read is not there, and what cannot be written is compiled again next time: a
    damaged file or a full disk ends no run.
    """

    def __init__(self, shared: Any, base: str) -> None:
        """Replace ``shared``, numba's own; names of files begin with ``base``, of the function.

        Raises AttributeError or TypeError if ``shared`` is not as this class needs it.
        """
        self._shared, self._base = shared, base
        self._of(())

    def save(self, key: Hashable, data: Any) -> None:
        """Write the code ``data`` for ``key``: the signature, and the processor."""
        files = self._of(key)
        with suppress(OSError):
            try:
                files.save(key, data)
            except DAMAGED:
                files.flush()
                files.save(key, data)

    def load(self, key: Hashable) -> Any:
        """Return the code for ``key``; None where it is not known."""
        try:
            return self._of(key).load(key)
        except (OSError, *DAMAGED):
            return None

    def flush(self) -> None:
        """Forget all code of the function."""
        for index in Path(self._shared._cache_path).glob(f"{self._base}-*.nbi"):
            index.unlink(missing_ok=True)

    def _of(self, key: Hashable) -> Any:
        name = f"{self._base}-{sha256(repr(key).encode()).hexdigest()[:16]}"
        return type(self._shared)(self._shared._cache_path, name, self._shared._source_stamp)


def separate_code(dispatcher: Any) -> None:
    """Have ``dispatcher``, which numba has given a cache, store its code in `CodeFiles`.

    They use names that numba does not promise. Where one is missing, the code stays in the files of
    numba.
    """
    with suppress(AttributeError, TypeError):
        cache = dispatcher._cache
        cache._cache_file = CodeFiles(cache._cache_file, cache._impl.filename_base)
