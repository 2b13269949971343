"""Whose fault it is: the device's, or the suite's own.

What the user can mend by another command line is a `floatref.errors.InputError`.
"""


class DeviceError(Exception):
    """The device crashed or delivered something unusable; the text is one line."""


class SuiteError(Exception):
    """The suite cannot judge because it is itself at fault; there is no verdict."""
