"""The worst numbers of a worksheet, measured again by the reference implementation."""

from floatref_conformance.certify.worksheet import Worksheet


def confirm_worksheet(worksheet: Worksheet) -> None:
    """Raise SuiteError unless the reference gives the worst numbers of ``worksheet`` too."""
    raise NotImplementedError
