"""Errors of the device under test, and errors of the suite itself.

An error that the user can correct on the command line is a `floatref.errors.InputError`.
"""

from floatref.errors import InputError


class DeviceError(Exception):
    """The device crashed or delivered something unusable; the text is one line."""


class DeviceHung(DeviceError):
    """The device did not answer in time."""


class DeviceRefused(DeviceError):
    """The device answered an error in place of a profile."""


class DeviceSkipped(Exception):
    """The device does not process this recording; the text is its reason, in one line."""


class NoRoom(InputError):
    """The disk has no room for what a run writes; the text is one line, and there is no verdict."""


class SuiteError(Exception):
    """The suite cannot judge because of its own error; there is no verdict."""
