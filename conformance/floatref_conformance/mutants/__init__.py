"""Errors of a profiler's software: each mutation puts one error into a sound pipeline."""

from floatref_conformance.mutants.in_drives import IN_DRIVES
from floatref_conformance.mutants.in_fusion import IN_FUSION
from floatref_conformance.mutants.in_processing import IN_PROCESSING, IN_RESPONSE
from floatref_conformance.mutants.in_results import IN_RESULTS
from floatref_conformance.mutants.in_sensors import IN_SENSORS
from floatref_conformance.mutants.in_surroundings import IN_SURROUNDINGS
from floatref_conformance.mutants.other_profilers import OTHER_PROFILERS

MUTATIONS = (
    *IN_SENSORS,
    *IN_PROCESSING,
    *IN_RESULTS,
    *IN_DRIVES,
    *IN_FUSION,
    *IN_RESPONSE,
    *IN_SURROUNDINGS,
    *OTHER_PROFILERS,
)
"""All mutations in the order in which they are listed."""
