"""The report of `floatref allan`: channels, coefficients, settings and warnings."""

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.measures.allan.at_rest import ChannelNoise
from floatref.measures.allan.noise_fit import NoiseCoefficients
from floatref.values.display.similar_names import suggest
from floatref.values.recording import Channel, Recording

ANALYSED = (
    *("roll_rate", "pitch_rate", "yaw_rate"),
    *("vertical_specific_force", "longitudinal_specific_force", "lateral_specific_force"),
    *("height", "gnss_height", "gnss_vertical_velocity", "gnss_pitch", "gnss_roll"),
)
"""Channels that are constant at rest, but for noise."""
SETTINGS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "acceleration_density": ("vertical_specific_force", "white_noise"),
        "acceleration_walk": ("vertical_specific_force", "random_walk"),
        "roll_rate_density": ("roll_rate", "white_noise"),
        "pitch_rate_density": ("pitch_rate", "white_noise"),
        "yaw_rate_density": ("yaw_rate", "white_noise"),
        "roll_rate_walk": ("roll_rate", "random_walk"),
        "pitch_rate_walk": ("pitch_rate", "random_walk"),
    }
)
"""Settings of the Kalman pipelines, each with its channel and coefficient."""
UNITS: Mapping[str, str] = MappingProxyType(
    {
        "ramp": "{}/s",
        "random_walk": "{}/√s",
        "bias_instability": "{}",
        "white_noise": "{}/√Hz",
        "quantization": "{}·s",
    }
)
"""Units of the coefficients of a signal in the unit {}."""
AT_REST: Mapping[str, float] = MappingProxyType({"rad/s": 2e-3, "m/s^2": 0.05, "m/s": 0.15})
"""Limit of the deviation in the sensor's unit: sensors at rest are below, in motion above."""
SWAYS_S = 0.3
"""Cluster time in s in which a moving vehicle sways."""
TRAVEL_M = 0.1
POOR = 1.5
"""Factor between curve and deviation from which the curve does not describe the noise."""
STUCK, STUCK_S = 100.0, 1.0
"""Shortest run of identical samples of a stuck sensor, in usual runs and in s."""
RTK_FIXED = 4.0
DIGITS = 4
"""Digits of a setting, whose uncertainty is one per cent or more."""


def choose_channels(recording: Recording, names: Sequence[str]) -> tuple[Channel, ...]:
    """Return the channels called ``names``, with or without a track, or all that are analysed.

    Raises InputError for a name of no such channel.
    """
    there = [c for name in ANALYSED for c in recording.channels if c.id.name == name]
    if not there:
        raise InputError(
            f"no channel has noise at rest to analyse; possible channels are {_list()}"
        )
    known = {str(c.id) for c in there} | {c.id.name for c in there}
    for name in names:
        if name not in known:
            here = suggest(name, [str(c.id) for c in there])
            raise InputError(f"channel {name}: cannot be analysed here; {here}")
    return tuple(c for c in there if not names or {c.id.name, str(c.id)} & set(names))


def allan_report(found: Sequence[ChannelNoise], warnings: Sequence[str]) -> dict[str, Any]:
    """Return the JSON document of `floatref allan --json`."""
    return {
        "settings": {name: _round(value) for name, (value, _) in recommend_settings(found).items()},
        "channels": [_channel_report(noise) for noise in found],
        "warnings": list(warnings),
    }


def recommend_settings(found: Sequence[ChannelNoise]) -> dict[str, tuple[float, ChannelNoise]]:
    """Return settings of the Kalman pipelines in SI units, and the channel of each.

    Of several wheel paths the noisiest counts. A coefficient that the data do not show, or a curve
    that is off by `POOR` somewhere, gives no setting.
    """
    settings = {}
    for name, (channel, term) in SETTINGS.items():
        sound = (x for x in found if x.id.name == channel and x.fit.worst()[0] <= POOR)
        values = [(getattr(x.fit.coefficients, term), x) for x in sound]
        value, noise = max(values, key=lambda pair: pair[0], default=(0.0, None))
        if noise is not None and value > 0:
            settings[name] = (value, noise)
    return settings


def check_noise(noise: ChannelNoise, channel: Channel) -> Iterator[str]:
    """Yield warnings about the noise of ``channel``, one line each."""
    stretch, where = noise.stretch, f"channel {noise.id}"
    span = f"{noise.begin_s:.6g} s to {noise.end_s:.6g} s"
    if stretch.left_out:
        yield (
            f"{where}: samples missing or at uneven times; {span} is the longest complete stretch, "
            f"and {100 * stretch.count / channel.values.size:.3g} % of all; the rest is not used"
        )
    held_s = stretch.longest_held * stretch.interval_s
    if held_s >= STUCK_S and stretch.longest_held > STUCK * stretch.held:
        yield f"{where}: stuck for {held_s:.4g} s; record again, or cut that part away"
    limit = AT_REST.get(noise.unit, np.inf)
    swaying = noise.allan.deviation[int(np.abs(np.log(noise.allan.cluster_s / SWAYS_S)).argmin())]
    if swaying > limit:
        yield (
            f"{where}: {swaying:.3g} {noise.unit} between clusters of {SWAYS_S:g} s is more than "
            "noise; record with the vehicle still, engine off and nobody in it"
        )
    factor, at_s = noise.fit.worst()
    if factor > POOR:
        yield (
            f"{where}: the curve is off by a factor of {factor:.3g} at {at_s:.3g} s, so do not "
            "rely on it; see --plot, and fit the part that it follows with --between"
        )


def check_stationary(recording: Recording) -> Iterator[str]:
    """Yield warnings about a recording that was not, or not completely, made at rest."""
    for channel in recording.channels:
        if channel.id.name == "distance":
            summary = channel.scan.summary
            if summary.greatest - summary.least > TRAVEL_M:
                yield (
                    f"channel {channel.id}: grows by {summary.greatest - summary.least:.4g} m; if "
                    "the vehicle moved, and not its encoder alone, that motion is taken for noise"
                )
        if channel.id.name == "gnss_quality":
            known = channel.values[~np.isnan(channel.values)]
            if (known != RTK_FIXED).any():
                share = 100 * float(np.mean(known != RTK_FIXED))
                yield f"channel {channel.id}: {share:.3g} % of the readings are not RTK fixed (4)"


def unit_of(term: str, unit: str) -> str:
    """Return the unit of coefficient ``term`` of a signal in ``unit``."""
    return UNITS[term].format(unit.replace("^2", "²"))


def _channel_report(noise: ChannelNoise) -> dict[str, Any]:
    factor, at_s = noise.fit.worst()
    allan = noise.allan
    fitted = noise.fit.allan.cluster_s
    return {
        "name": noise.id.name,
        "track": noise.id.track,
        "unit": noise.unit,
        "begin_s": noise.begin_s,
        "end_s": noise.end_s,
        "interval_s": allan.interval_s,
        "samples": allan.count,
        "standard_deviation": allan.standard_deviation,
        "coefficients": [_coefficient(noise, term) for term in NoiseCoefficients._fields],
        "fitted_from_s": float(fitted[0]),
        "fitted_to_s": float(fitted[-1]),
        "worst_factor": factor,
        "worst_at_s": at_s,
        "cluster_s": allan.cluster_s,
        "deviation": allan.deviation,
        "fitted_deviation": noise.fit.coefficients.deviation(allan.cluster_s),
    }


def _coefficient(noise: ChannelNoise, term: str) -> dict[str, Any]:
    value = getattr(noise.fit.coefficients, term)
    begin, end = noise.fit.dominates(term) or (np.nan, np.nan)
    return {
        "name": term,
        "unit": unit_of(term, noise.unit),
        "value": value if value > 0 else None,
        "uncertainty": getattr(noise.fit.uncertainties, term) if value > 0 else None,
        "below": getattr(noise.fit.limits, term),
        "largest_from_s": begin,
        "largest_to_s": end,
    }


def _round(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def _list() -> str:
    return ", ".join(ANALYSED)
