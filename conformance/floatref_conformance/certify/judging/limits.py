"""What a profiler has to reach: the limits of AASHTO R 56-14 and R 57-14, and ours by class."""

from dataclasses import dataclass

from floatref_conformance.classes import DeviceClass


@dataclass(frozen=True)
class CertificationLimits:
    """The limits of a worksheet; None: reported, not judged.

    Attributes:
        runs: repeated runs at each test section, at least.
        repeatability: cross correlation of the runs, averaged over all pairs.
        accuracy: cross correlation with the reference, averaged over the runs.
        distance_percent: error of the distance, in magnitude.
        height_percent: error of the scale of heights, in magnitude.
        iri_bias_percent: mean error of the IRI against the reference's, in magnitude.
        long_wave_percent: error of waves of 4 to 25 m, beyond the scale of heights.
        quiescent_m_per_km, bounce_m_per_km: IRI of the stationary tests.
    """

    runs: int = 10
    repeatability: float = 0.92
    accuracy: float = 0.90
    distance_percent: float | None = 0.15
    height_percent: float | None = 1.0
    iri_bias_percent: float | None = None
    long_wave_percent: float | None = 5.0
    quiescent_m_per_km: float = 0.047
    bounce_m_per_km: float = 0.126


def limits_of(device_class: DeviceClass) -> CertificationLimits:
    """Return the limits of ``device_class``; nominal is the practice's own."""
    return {
        DeviceClass.NOMINAL: CertificationLimits(),
        DeviceClass.ADEQUATE: CertificationLimits(
            repeatability=0.95, accuracy=0.92, iri_bias_percent=5.0
        ),
        DeviceClass.REFERENCE: CertificationLimits(
            repeatability=0.98,
            accuracy=0.98,
            iri_bias_percent=2.0,
            quiescent_m_per_km=0.047 / 2,
            bounce_m_per_km=0.126 / 2,
        ),
    }[device_class]
