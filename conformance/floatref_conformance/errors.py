"""Whose fault it is: the device's, or the suite's own.

What the user can mend by another command line is a `floatref.errors.InputError`.
"""


class DeviceError(Exception):
    """The device crashed or delivered something unusable; the text is one line."""


class DeviceHung(DeviceError):
    """The device did not answer in time."""


class DeviceSkipped(Exception):
    """The device does not take this recording, for the reason that it gives in one line."""


class SuiteError(Exception):
    """The suite cannot judge because it is itself at fault; there is no verdict."""
