"""Reading a profile of any registered format."""

from pathlib import Path

from floatref.architectures.plugins import plugins
from floatref.architectures.profile_format import ProfileFormat
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.files import read_profile
from floatref.values.profile import Profile


def profile_of(path: Path) -> Profile:
    """Return the profile at ``path``: our directory, its profile.json, or a file of any format.

    A file that no format recognises is read as our CSV, whose errors say what is expected. Raises
    InputError if ``path`` cannot be used or two formats recognise it, and PluginError if a format
    fails in a way it should not.
    """
    path = Path(path)
    found = [form for form in plugins().profile_formats().values() if _recognised(form, path)]
    if not found:
        return read_profile(path)
    if len(found) > 1:
        both = " and ".join(form.name for form in found)
        raise InputError(f"{path}: formats {both} both recognise it; remove one plug-in")
    return _read(found[0], path)


def failure(form: ProfileFormat, path: Path, error: Exception) -> str:
    """Return in one line what went wrong inside ``form``."""
    reason = f"{type(error).__name__}: {' '.join(str(error).split())}"
    return f"format {form.name}: {path}: {reason}"


def _recognised(form: ProfileFormat, path: Path) -> bool:
    try:
        return bool(form.recognises(path))
    except (OSError, ValueError):
        # A name that cannot be opened: reading it says so.
        return False
    except Exception as error:
        plugins().reports.append(failure(form, path, error))
        return False


def _read(form: ProfileFormat, path: Path) -> Profile:
    try:
        profile = form.read(path)
    except (FloatrefError, OSError):
        raise
    except Exception as error:
        raise PluginError(failure(form, path, error)) from error
    if not isinstance(profile, Profile):
        raise PluginError(f"format {form.name}: {path}: gave no profile")
    return profile
