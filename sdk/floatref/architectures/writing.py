"""Writing a profile in any registered format: which one a name asks for, complete or not at all."""

from pathlib import Path

from floatref.architectures.plugins import plugins
from floatref.architectures.profile_format import ProfileDirectory, ProfileFormat
from floatref.architectures.reading import failure
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.files import write_profile
from floatref.files.atomic import replacing_file
from floatref.files.sources import naming
from floatref.values.profile import Profile


def format_of(out: Path, name: str | None = None) -> ProfileFormat:
    """Return the format called ``name``, else the one that the suffix of ``out`` asks for.

    Raises InputError, with the formats there are, if it is none or that of two, or if it needs a
    library that is missing.
    """
    form = _chosen(out, name)
    check = getattr(form, "check_installed", None)
    if callable(check):
        with naming(out):
            check()
    return form


def _chosen(out: Path, name: str | None) -> ProfileFormat:
    known = plugins().profile_formats()
    if name is not None and name not in known:
        raise InputError(f"format {name}: unknown; there are {', '.join(known)}")
    if name is not None:
        return known[name]
    # A suffix has letters only: names of runs hold numbers, as in stop_0.20g.
    suffix = out.suffix.lower() if out.suffix[1:].isalpha() else ""
    found = [form for form in known.values() if form.suffix == suffix]
    if len(found) > 1:
        both = " and ".join(form.name for form in found)
        raise InputError(f"{out}: suffix {suffix} is that of {both}; choose with --format")
    if not found:
        suffixes = ", ".join(form.suffix for form in known.values() if form.suffix)
        raise InputError(
            f"{out}: suffix {out.suffix} is no format; use {suffixes}, no suffix, or --format "
            f"with one of {', '.join(known)}"
        )
    return found[0]


def write_as(form: ProfileFormat, profile: Profile, out: Path, overwrite: bool = False) -> None:
    """Write ``profile`` to ``out`` in the format ``form``, complete or not at all.

    Raises InputError if ``out`` exists and ``overwrite`` is false, cannot be written, or if the
    format cannot hold the profile; PluginError if a format fails in a way it should not.
    """
    if isinstance(form, ProfileDirectory):
        write_profile(profile, out, overwrite)
        return
    with replacing_file(out, overwrite) as beside:
        try:
            form.write(profile, beside)
        except InputError as error:
            raise InputError(str(error).replace(str(beside), str(out))) from error
        except (FloatrefError, OSError):
            raise
        except Exception as error:
            raise PluginError(failure(form, out, error)) from error
        if not beside.is_file():
            raise PluginError(f"format {form.name}: {out}: wrote no file")
