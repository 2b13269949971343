"""Golden vectors: what every stage has to make of a few hundred samples, in any language.

Each is a JSON file, `floatref-golden/1`, with settings, inputs, the outputs of the reference, and
the tolerance in double and in single precision.
"""

import json
from collections.abc import Iterator
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest

FORMAT = "floatref-golden/1"
SUFFIX = ".json"


def names() -> tuple[str, ...]:
    """Return the names of all vectors, sorted; the stage's, with a suffix if it has several."""
    return tuple(sorted(file.name.removesuffix(SUFFIX) for file in _stored_files()))


def read(name: str) -> dict[str, Any]:
    """Return the JSON document of vector ``name``; InputError if it is unknown."""
    document: dict[str, Any] = json.loads(_file(name).read_text(encoding="utf-8"))
    return document


def copy_to(folder: Path) -> tuple[Path, ...]:
    """Write every vector as ``<name>.json`` into ``folder``, which is made if need be.

    Returns the files. Raises InputError naming the file that cannot be written.
    """
    copies = tuple(folder / f"{name}{SUFFIX}" for name in names())
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for copy in copies:
            copy.write_bytes(_file(copy.stem).read_bytes())
    except OSError as error:
        raise InputError(
            f"{error.filename or folder}: {error.strerror}; choose another folder"
        ) from error
    return copies


def _stored_files() -> Iterator[Traversable]:
    return (file for file in files(__name__).iterdir() if file.name.endswith(SUFFIX))


def _file(name: str) -> Traversable:
    known = names()
    if name not in known:
        hint = suggest(name, known, "known:")
        raise InputError(f"golden vector {name}: unknown; {hint}")
    return files(__name__) / f"{name}{SUFFIX}"
