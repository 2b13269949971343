"""Files that plug-ins read and write: their own failures as one line, and nothing half-written."""

from collections.abc import Callable
from pathlib import Path

from floatref.errors import FloatrefError, InputError, PluginError
from floatref.files.atomic import replace_file


def failure(reader: str, path: Path, error: BaseException) -> str:
    """Return one line on an ``error`` that ``reader``, an adapter or a format, raised."""
    return f"{reader}: {path}: {type(error).__name__}: {' '.join(str(error).split())}"


def write_file(
    name: str, out: Path, write: Callable[[Path], None], overwrite: bool = False
) -> None:
    """Let ``write``, of the format called ``name``, make a file beside ``out``, then rename it.

    Raises InputError as ``write`` does, with the name of ``out``, and PluginError for its others.
    """
    with replace_file(out, overwrite) as beside:
        try:
            write(beside)
        except InputError as error:
            raise InputError(str(error).replace(str(beside), str(out))) from error
        except (FloatrefError, OSError, KeyboardInterrupt):
            raise
        except BaseException as error:
            raise PluginError(failure(f"format {name}", out, error)) from error
        if not beside.is_file():
            raise PluginError(f"format {name}: {out}: wrote no file")
