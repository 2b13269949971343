"""Features of a profile: the drives that pass them, and their places in a profile."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil
from typing import Any

import numpy as np

from floatref.measures import cross_correlation, on_common_grid, waveband_slope
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile
from floatref_conformance.checks.encoder_axis import EncoderAxis
from floatref_conformance.checks.scoring import bridge
from floatref_conformance.checks.stretches import Stretches, points, stretch
from floatref_conformance.editions.edition import Edition
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

FEATURE_M = 25.0
"""Length of a feature, in m."""
FARTHEST_M = 3.0
"""Largest distance in m from its place at which a feature is searched."""
BAND = "medium"
"""1.6 to 8 m (section 2.1.5.2): no event disturbs such short waves beyond `BESIDE_EVENT_M`."""
END_M = 110.0
"""Distance in m of features from both ends of the run, where a filter may omit points."""
BESIDE_EVENT_M = 60.0
"""Distance in m of features from a stop or a release of the brake."""


@dataclass(frozen=True)
class Feature:
    """A stretch of road on the encoder's axis.

    Attributes:
        at_m: true place of its middle, in m.
        lag_m: displacement of the feature in the profile, forward positive, in m.
        loss: one minus (2.16) at that lag.
    """

    at_m: float
    lag_m: float
    loss: float


@dataclass(frozen=True)
class Placement:
    """The lags of features as a line along the axis, with a step at an event.

    Attributes:
        start_m: lag at distance 0, in m.
        scale: change of lag per distance.
        step_m: change of lag at the event, in m.
        rest_m: largest deviation of a lag from the line with its step, in m.
    """

    start_m: float
    scale: float
    step_m: float
    rest_m: float


def feature_stretches(length_m: float, event_m: float | None) -> Stretches:
    """Return the stretches of a drive that contain features, one next to the other."""
    end_m = length_m - END_M
    if event_m is None:
        return (_fill(END_M, end_m),)
    ahead, behind = event_m - BESIDE_EVENT_M, event_m + BESIDE_EVENT_M
    return _fill(END_M, ahead), _fill(behind, end_m)


def middles(length_m: float, event_m: float | None) -> FloatArray:
    """Return the true places of the middles of a drive's features, in m."""
    filled = feature_stretches(length_m, event_m)
    return np.concatenate([_split_middles(start, end) for start, end in filled])


def find_features(
    profile: Profile, truth: Profile, track: str, axis: EncoderAxis, middles_m: FloatArray
) -> tuple[Feature, ...]:
    """Return the features whose middles have the true places ``middles_m``, in m.

    Raises DeviceError if a point of one of them has no elevation.
    """
    wanted = axis.place(replace(truth, tracks=(truth.track(track),)))
    true, found = on_common_grid(wanted, profile)
    places = [float(place_m) for place_m in axis.to_encoder(middles_m)]
    for at in places:
        stretch(found, track, at - FEATURE_M / 2, at + FEATURE_M / 2)
    z = true.track(track).elevation
    both = (z, bridge(found.track(track).elevation, z))
    slopes = [waveband_slope(elevation, true.interval_m, BAND) for elevation in both]
    return tuple(_find_feature(slopes, true, at) for at in places)


def place(features: Sequence[Feature], event_m: float | None) -> Placement:
    """Return the line that fits the lags best; ``event_m`` is on the encoder's axis."""
    at, lag = np.array([(f.at_m, f.lag_m) for f in features]).T
    columns = [np.ones_like(at), at]
    if event_m is not None:
        columns.append(np.where(at > event_m, 1.0, 0.0))
    matrix = np.stack(columns, axis=1)
    line = np.linalg.lstsq(matrix, lag, rcond=None)[0]
    rest = float(np.max(np.abs(lag - matrix @ line)))
    step = 0.0 if event_m is None else float(line[2])
    return Placement(float(line[0]), float(line[1]), step, rest)


def _fill(start_m: float, end_m: float) -> tuple[float, float]:
    """Return the stretch from ``start_m`` on with whole features, up to ``end_m`` at most."""
    return start_m, start_m + FEATURE_M * max(0, int((end_m - start_m) / FEATURE_M + 1e-6))


def _split_middles(start_m: float, end_m: float) -> FloatArray:
    """Return the middles of the features that fill the stretch between two distances, in m."""
    count = round((end_m - start_m) / FEATURE_M)
    return start_m + FEATURE_M * (np.arange(count, dtype=np.float64) + 0.5)


def _find_feature(slopes: Sequence[FloatArray], profile: Profile, at_m: float) -> Feature:
    inside = points(profile, at_m - FEATURE_M / 2, at_m + FEATURE_M / 2)
    true, found = (slope[inside] for slope in slopes)
    agreed = cross_correlation(true, found, profile.interval_m, FARTHEST_M)
    return Feature(at_m, agreed.offset_m, 1.0 - agreed.cross_correlation)


FEATURES = 4
"""Number of features before an event, and behind it."""


def scenario_of(numbers: Mapping[str, Any], edition: Edition) -> Scenario:
    """Return the scenario of ``numbers``, with room for the features around its event."""
    wanted = edition.make_scenario(**numbers)
    braking_m = (wanted.speed_kmh * KMH) ** 2 / (2 * STANDARD_GRAVITY * wanted.deceleration_g)
    room_m = BESIDE_EVENT_M + FEATURES * FEATURE_M + END_M
    event_m = max(room_m, BESIDE_EVENT_M + 10.0 * ceil(0.13 * braking_m))
    return replace(wanted, event_at_m=event_m, length_m=event_m + room_m)


def event_of(scenario: Scenario) -> float | None:
    """Return the true distance of the stop or the release in m; None without an event."""
    return None if scenario.manoeuvre == "constant" else scenario.event_at_m
