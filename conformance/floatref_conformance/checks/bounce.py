"""`bounce`: what the body does over a standing wheel must not reach the profile."""

from floatref_conformance.checks.stationary import StationaryCheck
from floatref_conformance.classes import same_limit

NOMINAL_M_PER_KM = 0.126
"""AASHTO R 57-14, bounce part of the stationary test."""
REFERENCE_M_PER_KM = NOMINAL_M_PER_KM / 2

BOUNCE = StationaryCheck(
    id="bounce",
    title="motion of the body over a flat floor does not reach the profile",
    clause="AASHTO R 57-14, bounce test: IRI 0.126 m/km; class reference: half",
    derivation=(
        "The vehicle stands on a flat floor with its engine on, an artificial encoder tells "
        "72 km/h, and from 10 s on the body is pushed for 6.5 s at 2 Hz, 56 mm down and 30 mm up "
        "during the middle two thirds. The IRI is taken over just those two thirds, 221.7 to "
        "308.3 m, where the motion is at its most severe: accelerometer and height sensor have to "
        "cancel. The nominal system of Karamihas 2021 (figure 4.7) had 0.05 m/km there. A "
        "difference in delay of 0.155 ms, the mean age of a laser reading held at 3.24 kHz, "
        "leaves 0.08 mm at a wavelength of 10 m. Half the limit is asked of class reference."
    ),
    iri_limits=same_limit(NOMINAL_M_PER_KM, REFERENCE_M_PER_KM),
    start_m=221.7,
    end_m=308.3,
)
