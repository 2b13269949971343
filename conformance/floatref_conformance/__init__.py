"""The proving ground, the checks and the judge of inertial profiling software.

A check draws cases from a seed, has each simulated with its truth, gives the device under
test what a profiler's sensors would have recorded, and measures the profile that comes back.
Units and axes are those of `floatref`: SI, ISO 8855, IRI in m/km.
"""

EDITION = "2026.1"
"""Edition of the checks: it fixes the manoeuvres and the limits; the seed draws the rest."""
