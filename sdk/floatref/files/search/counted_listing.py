"""Lists folders for one search and counts what it lists, so that no search goes on unseen.

A pattern such as `/**/*` leads through a whole machine, and a folder higher up holds all of a disk.
"""

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from floatref.errors import InputError

MOST = 100_000
"""Largest number of files and folders that one search looks at."""


class CountedListing:
    """The folders that are listed for one search."""

    def __init__(self, text: str) -> None:
        """Begin the search that the user asked for with ``text``."""
        self._text, self._count = text, 0

    def entries(self, folder: Path) -> Iterator[os.DirEntry[str]]:
        """Yield what is in ``folder``.

        Raises InputError as soon as the search has looked at more than `MOST` files and folders,
        and OSError for a folder that cannot be listed.
        """
        with os.scandir(folder) as found:
            for entry in found:
                self._count += 1
                if self._count > MOST:
                    raise InputError(
                        f"{self._text}: more than {MOST} files and folders to look at; name a "
                        "folder nearer to the files, or the files themselves"
                    )
                yield entry

    def readable(self, folder: Path) -> Iterator[os.DirEntry[str]]:
        """Yield as `entries` does; nothing for what is no folder, or cannot be listed."""
        with suppress(OSError):
            yield from self.entries(folder)

    def check_below(self, folder: Path) -> None:
        """Count all that lies below ``folder``, links not followed; InputError as `entries`."""
        waiting = [folder]
        while waiting:
            entries = self.readable(waiting.pop())
            waiting += [Path(entry.path) for entry in entries if is_real_folder(entry)]


def is_real_folder(entry: os.DirEntry[str]) -> bool:
    """Return whether ``entry`` is a folder and no link to one: links may lead round in a ring."""
    try:
        return entry.is_dir(follow_symlinks=False)
    except OSError:
        return False
