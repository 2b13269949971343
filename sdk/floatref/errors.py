"""The errors a user can act on."""


def one_line(text: str) -> str:
    """Return ``text`` with characters that are not printable, such as line ends, escaped."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


class FloatrefError(Exception):
    """Base of every error that floatref raises on purpose; its text is one clear line."""

    def __str__(self) -> str:
        """Return the text on one line: names from files may hold line ends and escapes."""
        return one_line(super().__str__())


class InputError(FloatrefError, ValueError):
    """A file, channel, value or setting that cannot be used; the text says what to do."""


class TargetExists(InputError):
    """A target that exists and is not to be replaced."""


def missing_extra(task: str, extra: str) -> InputError:
    """Return the error of a ``task`` that needs the packages of ``extra``, with how to get them.

    No package index has floatref: an extra is installed in a clone. Double quotes are those
    that every shell understands, that of Windows included.
    """
    return InputError(f'{task}; run in a clone of floatref: pip install -e ".[{extra}]"')


class StageError(FloatrefError, RuntimeError):
    """A stage was called out of order or with an incomplete set of calls."""


class PluginError(FloatrefError, RuntimeError):
    """Two plug-ins answered one point, a name was registered twice, or an answer is unusable."""
