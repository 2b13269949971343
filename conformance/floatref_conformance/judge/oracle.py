"""The second opinion: the reference implementation measures the same value again.

The checks and the pipelines both use the measures of the SDK. An error in these measures would
otherwise remain undetected.
"""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.errors import SuiteError
from floatref_reference.chapter_2 import section_2_1_1_iri as section_2_1_1
from floatref_reference.chapter_2 import section_2_1_5_comparison as section_2_1_5

TOLERANCE = 1e-3
"""Largest difference between the two values, relative to the value or to `SMALLEST` units."""
SMALLEST = {"m/km": 1e-3, "%": 1e-1}
"""Smallest scale of the comparison: a smaller value is a difference of larger ones."""
DIMENSIONLESS = 1e-3


class PrintedMeasures:
    """The measures of the reference implementation, as Python floats."""

    def iri(self, elevation: FloatArray, interval_m: float) -> float:
        """Return the IRI of section 2.1.1 in m/km."""
        return float(section_2_1_1.iri(np.array(elevation), interval_m))

    def iri_trace(self, elevation: FloatArray, interval_m: float) -> FloatArray:
        """Return the output of steps 1 to 3 of section 2.1.1 in m/km."""
        trace = section_2_1_1.iri_trace(np.array(elevation), interval_m)
        return np.asarray(trace, dtype=np.float64)

    def score(self, p: FloatArray, q: FloatArray, lag: int) -> float:
        """Return (2.14) times (2.15) at one offset."""
        p, q = np.array(p), np.array(q)
        rho = section_2_1_5.correlation(p, q, lag)
        return float(rho * section_2_1_5.amplitude_factor(p, q, lag))


def confirm(check: str, measured: Measurement) -> None:
    """Raise SuiteError unless the reference measures the same value as ``measured``.

    A measurement without evidence is not verified: the reference does not have its measure.
    """
    if measured.evidence is None:
        return
    again = measured.evidence.value(PrintedMeasures())
    scale = max(abs(again), SMALLEST.get(measured.unit, DIMENSIONLESS))
    if not abs(again - measured.value) <= TOLERANCE * scale:
        raise SuiteError(
            f"check {check}, track {measured.track}: {measured.quantity} is "
            f"{measured.value:.6g} {measured.unit}, by the reference {again:.6g}"
        )
