"""Measures of a profile: IRI, where its roughness lies, and its agreement with another.

Each function takes a one-dimensional float64 elevation in m and its constant interval in
m. NaN marks points that were not measured: gaps are bridged by a straight line, and nothing is
calculated before the first and after the last measured point. Measures of sensors at rest, by
Allan deviation, take a channel or its samples.
"""

from floatref.measures.allan.at_rest import ChannelNoise, channel_noise
from floatref.measures.allan.deviation import AllanDeviation, allan_deviation
from floatref.measures.allan.noise_fit import NoiseCoefficients, NoiseFit, fit_noise
from floatref.measures.roughness.agreement import Agreement, cross_correlation, on_common_grid
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
    "ChannelNoise",
    "IriSettings",
    "LocalizedRoughness",
    "NoiseCoefficients",
    "NoiseFit",
    "ProfileIndex",
    "QuarterCar",
    "RoadSpectrum",
    "Segment",
    "WavelengthThresholds",
    "agreement",
    "allan_deviation",
    "channel_noise",
    "cross_correlation",
    "fit_noise",
    "high_pass",
    "in_per_mi",
    "iri",
    "iri_segments",
    "iri_trace",
    "localized_roughness",
    "m_per_km",
    "mean_roughness_index",
    "on_common_grid",
    "short_interval_roughness",
    "waveband_slope",
    "wavelength_thresholds",
]
