"""`quiescent`: parked with the engine on, a profiler measures a flat profile."""

from floatref_conformance.checks.stationary import StationaryCheck
from floatref_conformance.classes import same_limit

NOMINAL_M_PER_KM = 0.047
"""AASHTO R 57-14, static part of the stationary test."""
REFERENCE_M_PER_KM = NOMINAL_M_PER_KM / 2

QUIESCENT = StationaryCheck(
    id="quiescent",
    title="parked with the engine on, the profile is flat",
    clause="AASHTO R 57-14, static test: IRI 0.047 m/km; class reference: half",
    derivation=(
        "The vehicle stands on a flat floor, its engine at 820 rpm shakes the body by 10 µm at "
        "13.7 Hz, and an artificial encoder tells 72 km/h for 32 s. The IRI is taken over 160.9 m "
        "(0.1 mile) from 200 m on, away from both ends of the run and from the plate: what is "
        "there is the noise of the sensors and what the software makes of it. The nominal system "
        "of Karamihas 2021 (4.5.1) stayed below 0.01 m/km. Half the limit is asked of class "
        "reference, so that the profiler adds little to the roads that it is to judge others on."
    ),
    iri_limits=same_limit(NOMINAL_M_PER_KM, REFERENCE_M_PER_KM),
    start_m=200.0,
    end_m=360.9,
)
