"""Which profile formats recognise a path: commands tell a profile from a recording by it."""

from os.path import exists
from pathlib import Path

from floatref.engine.plugins import plugins
from floatref.engine.recordings.plug_in_files import failure
from floatref.files.profile_directory import DOCUMENT
from floatref.interfaces.profile_format import ProfileFormat


def profile_formats_of(path: Path) -> list[ProfileFormat]:
    """Return the profile formats that recognise ``path``; one that fails at it is reported."""
    return [form for form in plugins().profile_formats().values() if _recognise(form, path)]


def has_profile_form(path: Path) -> bool:
    """Return whether ``path`` exists and is in a profile format; a JSON file by its name alone."""
    # Our profile directory recognises any JSON file, to say what is wrong in a renamed one.
    other = path.suffix.lower() == ".json" and path.is_file() and path.name != DOCUMENT
    return exists(path) and not other and bool(profile_formats_of(path))


def _recognise(form: ProfileFormat, path: Path) -> bool:
    try:
        return bool(form.recognises(path))
    except (OSError, ValueError):
        # A name that cannot be opened: reading it raises the error.
        return False
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        plugins().reports.append(failure(f"format {form.name}", path, error))
        return False
