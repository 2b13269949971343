"""Choosing a profile format and calling it; its own failures as one line."""

import shlex
from os.path import exists
from pathlib import Path

from floatref.engine.plugins import plugins
from floatref.engine.recordings.plug_in_files import failure, write_file
from floatref.engine.recordings.readers import find_readers
from floatref.engine.recordings.recognising_profiles import profile_formats_of
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.files import read_profile, write_profile
from floatref.files.sources import check_source, name_errors
from floatref.files.withheld_formats import refuse_to_read, refuse_to_write
from floatref.interfaces.adapter import RecordingDirectory
from floatref.interfaces.profile_format import ProfileDirectory, ProfileFormat
from floatref.values.display.similar_names import hint_at, suggest
from floatref.values.profile import Profile


def profile_of(path: Path) -> Profile:
    """Return the profile at ``path``: our directory, its profile.json, or a file of any format.

    A file that no format recognises is read as our CSV, whose errors say what is expected. Raises
    InputError if ``path`` cannot be used or two formats recognise it, and PluginError for any other
    error of a format.
    """
    path = Path(path)
    check_source(path)
    found = profile_formats_of(path)
    if not found or RecordingDirectory().recognises(path):
        _refuse_recording(path)
    if not found:
        refuse_to_read(path)
        return read_profile(path)
    if len(found) > 1:
        both = " and ".join(form.name for form in found)
        raise InputError(f"{path}: formats {both} both recognise it; remove one plug-in")
    return _read(found[0], path)


def is_profile(path: Path) -> bool:
    """Return whether any format of profiles recognises ``path``."""
    return bool(profile_formats_of(path))


def _refuse_recording(path: Path) -> None:
    """Raise InputError for a recording: what to do is better known than what is wrong with it.

    Any table of text may be a CSV profile, whose own errors say what is missing in it.
    """
    if not exists(path):
        return
    readers = [adapter.name for adapter in find_readers(path) if adapter.name != "csv"]
    if readers:
        raise InputError(
            f"{path}: is a recording for adapter {' or '.join(readers)}, no profile; process it "
            f"first: floatref process {shlex.quote(str(path))} --out PROFILE"
        )


def _read(form: ProfileFormat, path: Path) -> Profile:
    try:
        profile = form.read(path)
    except (FloatrefError, OSError, KeyboardInterrupt):
        raise
    except BaseException as error:
        raise PluginError(failure(f"format {form.name}", path, error)) from error
    if not isinstance(profile, Profile):
        raise PluginError(f"format {form.name}: {path}: gave no profile")
    return profile


def format_of(out: Path, name: str | None = None) -> ProfileFormat:
    """Return the format called ``name``, else the one of the suffix of ``out``.

    Raises InputError, which lists the formats, if no format or more than one fits, or if it needs a
    library that is missing.
    """
    form = _choose(out, name)
    check = getattr(form, "check_installed", None)
    if callable(check):
        with name_errors(out):
            check()
    return form


def _choose(out: Path, name: str | None) -> ProfileFormat:
    known = plugins().profile_formats()
    if name is not None and name not in known:
        raise InputError(f"format {name}: unknown; {suggest(name, known)}")
    if name is not None:
        return known[name]
    # A suffix has letters only: names of runs hold numbers, as in stop_0.20g.
    suffix = out.suffix.lower() if out.suffix[1:].isalpha() else ""
    found = [form for form in known.values() if form.suffix == suffix]
    if len(found) > 1:
        both = " and ".join(form.name for form in found)
        raise InputError(f"{out}: suffix {suffix} is that of {both}; choose with --format")
    if not found:
        refuse_to_write(out)
        suffixes = [form.suffix for form in known.values() if form.suffix]
        raise InputError(
            f"{out}: suffix {out.suffix} is no format; use {', '.join(suffixes)}, no suffix, or "
            f"--format with one of {', '.join(known)}{hint_at(suffix, suffixes)}"
        )
    return found[0]


def write_as(form: ProfileFormat, profile: Profile, out: Path, overwrite: bool = False) -> None:
    """Write ``profile`` to ``out`` in the format ``form``, complete or not at all.

    Raises InputError if ``out`` exists and ``overwrite`` is false, cannot be written, or if the
    format cannot hold the profile; PluginError for any other error of the format.
    """
    if isinstance(form, ProfileDirectory):
        write_profile(profile, out, overwrite)
        return
    write_file(form.name, out, lambda beside: form.write(profile, beside), overwrite)
