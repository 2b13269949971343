"""The errors a user can act on."""


class FloatrefError(Exception):
    """Base of every error that floatref raises on purpose; its text is one clear line."""


class InputError(FloatrefError, ValueError):
    """A file, channel, value or setting that cannot be used; the text says what to do."""


class StageError(FloatrefError, RuntimeError):
    """A stage was called out of order or with an incomplete set of calls."""


class PluginError(FloatrefError, RuntimeError):
    """Two plug-ins answered the same question, or a name was registered twice."""
