"""Measures of a profile: IRI, where its roughness lies, what contracts pay by, and agreement.

Each function takes a one-dimensional float64 elevation in m and its constant interval in
m. NaN marks points that were not measured: gaps are bridged by a straight line, and nothing is
calculated before the first and after the last measured point. Measures of sensors at rest, by
Allan deviation, take a channel or its samples.
"""

from floatref.measures.allan.at_rest import ChannelNoise, channel_noise
from floatref.measures.allan.deviation import AllanDeviation, allan_deviation
from floatref.measures.allan.noise_fit import NoiseCoefficients, NoiseFit, fit_noise
from floatref.measures.common_grid import on_common_grid
from floatref.measures.ride.bumps_and_dips import bumps_and_dips, deviation_from_average
from floatref.measures.ride.deviation_areas import BumpOrDip
from floatref.measures.ride.hpms_segments import (
    HpmsSection,
    hpms_sections,
    rate_iri,
    rated_shares,
)
from floatref.measures.ride.profile_index import (
    IndexOfSegment,
    MustGrind,
    TraceRules,
    must_grind,
    profile_indices,
)
from floatref.measures.ride.profilograph import Profilograph, profilograph_trace, valid_frames
from floatref.measures.ride.rolling_straightedge import (
    StraightedgeResult,
    rolling_straightedge,
    straightedge_deviation,
)
from floatref.measures.ride.two_paths import (
    half_car_roughness_index,
    join_profile_indices,
    mean_path,
    ride_number,
    ride_profile_index,
)
from floatref.measures.ride.waveband_energy import (
    WavebandEnergy,
    waveband_elevation,
    waveband_energy,
)
from floatref.measures.roughness.agreement import Agreement, cross_correlation
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.quarter_car import GOLDEN_CAR, RIDE_NUMBER_CAR, QuarterCar
from floatref.measures.roughness.roughness_index import Segment, iri, iri_segments, iri_trace
from floatref.measures.roughness.roughness_profile import (
    LocalizedRoughness,
    in_per_mi,
    localized_roughness,
    m_per_km,
    mean_roughness_index,
    short_interval_roughness,
    valid_bases,
)
from floatref.measures.roughness.thresholds import (
    INDICES,
    SAMPLE_ROADS,
    ProfileIndex,
    RoadSpectrum,
    WavelengthThresholds,
    wavelength_thresholds,
)
from floatref.measures.roughness.wavebands import (
    BANDS,
    WAVEBANDS,
    Waveband,
    agreement,
    high_pass,
    waveband_slope,
)

__all__ = [
    "BANDS",
    "GOLDEN_CAR",
    "INDICES",
    "RIDE_NUMBER_CAR",
    "SAMPLE_ROADS",
    "WAVEBANDS",
    "Agreement",
    "AllanDeviation",
    "BumpOrDip",
    "ChannelNoise",
    "HpmsSection",
    "IndexOfSegment",
    "IriSettings",
    "LocalizedRoughness",
    "MustGrind",
    "NoiseCoefficients",
    "NoiseFit",
    "ProfileIndex",
    "Profilograph",
    "QuarterCar",
    "RoadSpectrum",
    "Segment",
    "StraightedgeResult",
    "TraceRules",
    "Waveband",
    "WavebandEnergy",
    "WavelengthThresholds",
    "agreement",
    "allan_deviation",
    "bumps_and_dips",
    "channel_noise",
    "cross_correlation",
    "deviation_from_average",
    "fit_noise",
    "half_car_roughness_index",
    "high_pass",
    "hpms_sections",
    "in_per_mi",
    "iri",
    "iri_segments",
    "iri_trace",
    "join_profile_indices",
    "localized_roughness",
    "m_per_km",
    "mean_path",
    "mean_roughness_index",
    "must_grind",
    "on_common_grid",
    "profile_indices",
    "profilograph_trace",
    "rate_iri",
    "rated_shares",
    "ride_number",
    "ride_profile_index",
    "rolling_straightedge",
    "short_interval_roughness",
    "straightedge_deviation",
    "valid_bases",
    "valid_frames",
    "waveband_elevation",
    "waveband_energy",
    "waveband_slope",
    "wavelength_thresholds",
]
