"""Choosing the format that a recording is written in, and writing it."""

from pathlib import Path

from floatref.engine.plugins import plugins
from floatref.engine.recordings.plug_in_files import write_file
from floatref.engine.recordings.readers import find_readers, is_native
from floatref.engine.recordings.recognising_profiles import has_profile_form, profile_formats_of
from floatref.errors import InputError
from floatref.files import write_recording
from floatref.files.sources import name_errors
from floatref.interfaces.recording_format import RecordingFolder, RecordingFormat
from floatref.values.recording import Recording


def recording_format_of(out: Path, name: str | None = None) -> RecordingFormat | None:
    """Return the recording format called ``name``, else that of the suffix of ``out``.

    None if neither is one; a name without a suffix may be a profile directory as well. Raises
    InputError if two have the suffix, or if the library it needs is missing.
    """
    known = plugins().recording_formats()
    if name is not None:
        return _installed(known[name], out) if name in known else None
    found = [form for form in known.values() if form.suffix and form.suffix == out.suffix.lower()]
    if len(found) > 1:
        both = " and ".join(form.name for form in found)
        raise InputError(f"{out}: suffix {out.suffix} is that of {both}; choose with --format")
    return _installed(found[0], out) if found else None


def is_recording(source: Path) -> bool:
    """Return whether ``source`` holds a recording that can be read without a channel map."""
    return any(not is_native(reader) for reader in find_readers(source))


def is_native_file(source: Path) -> bool:
    """Return whether an adapter lists the content of ``source``, which no profile format knows."""
    return any(map(is_native, find_readers(source))) and not profile_formats_of(source)


def is_profile_only(source: Path) -> bool:
    """Return whether ``source`` is in a profile format, and no adapter recognises it."""
    return has_profile_form(source) and not find_readers(source)


def holds_setup(form: RecordingFormat) -> bool:
    """Return whether the files of ``form`` hold the setup; a format that leaves it out says so."""
    return bool(getattr(form, "holds_setup", True))


def write_recording_as(
    form: RecordingFormat, recording: Recording, out: Path, overwrite: bool = False
) -> None:
    """Write ``recording`` to ``out`` in the format ``form``, complete or not at all.

    Raises InputError if ``out`` exists and ``overwrite`` is false, cannot be written, or if the
    format cannot hold the recording; PluginError for any other error of the format.
    """
    if isinstance(form, RecordingFolder):
        write_recording(recording, out, overwrite)
        return
    write_file(form.name, out, lambda beside: form.write(recording, beside), overwrite)


def _installed(form: RecordingFormat, out: Path) -> RecordingFormat:
    check = getattr(form, "check_installed", None)
    if callable(check):
        with name_errors(out):
            check()
    return form
