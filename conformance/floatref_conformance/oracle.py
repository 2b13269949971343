"""The second opinion: an IRI measured again by the reference implementation.

An error in the IRI of the SDK, by which the checks judge and with which a pipeline could
have been tuned, would otherwise pass on both sides.
"""

import numpy as np

from floatref_conformance.errors import SuiteError
from floatref_conformance.verdict import Measurement
from floatref_reference.chapter_2.section_2_1_1_iri import iri

TOLERANCE = 1e-3
"""Largest relative difference between the two values."""
SMALLEST = 1e-6
"""IRI in m/km below which the difference is taken relative to this."""


def confirm(check: str, measured: Measurement) -> None:
    """Raise SuiteError unless the reference gives ``measured`` too.

    A measurement without evidence is not an IRI and is left alone.
    """
    if measured.evidence is None:
        return
    again = float(iri(np.array(measured.evidence.elevation), measured.evidence.interval_m))
    if not abs(again - measured.value) <= TOLERANCE * max(abs(again), SMALLEST):
        raise SuiteError(
            f"check {check}, track {measured.track}: {measured.quantity} is "
            f"{measured.value:.6g} {measured.unit}, by the reference {again:.6g}"
        )
