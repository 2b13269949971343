"""An encoder that leaps on a hill or long waves leaves the road on both sides as it is."""

from dataclasses import replace

import numpy as np
import pytest

import floatref
from floatref import Recording
from floatref.measures import iri_trace
from floatref_conformance.proving_ground import Scenario, Simulation, simulate

AT_M, END_M, ROUND_M = 200.0, 120.0, 7.62
LOCAL = 2.112
"""What the judge allows class nominal, in m/km over 7.62 m: 0.1 m/km in 160.9 m."""


def drive(road: str, grade_percent: float) -> Simulation:
    numbers = {"road": road, "grade_percent": grade_percent, "speed_kmh": 45.0}
    fixed = {"length_m": 400.0, "rate_hz": 4000.0, "tracks": ("left",), "vehicle": "minivan"}
    return simulate(Scenario(seed=5, iri_m_per_km=2.5, slip_percent_per_g=0.0, **numbers, **fixed))


def leaping(recording: Recording, size_m: float) -> Recording:
    """Return ``recording`` with ``size_m`` counted at once at `AT_M`."""
    encoder = recording.channel("distance", "left")
    values = np.where(encoder.values >= AT_M, encoder.values + size_m, encoder.values)
    changed = replace(encoder, values=values)
    others = [c for c in recording.channels if c.id != encoder.id]
    # Places of GNSS would say that the encoder is wrong from there on.
    kept = [c for c in others if c.id.name not in ("gnss_latitude", "gnss_longitude")]
    return replace(recording, channels=(changed, *kept))


def local_errors(simulation: Simulation, size_m: float, pipeline: str) -> tuple[float, float]:
    """Return the largest error in m/km over `ROUND_M` that is valid, and the metres flagged."""
    usual, found = (
        floatref.process(r, pipeline)
        for r in (simulation.recording, leaping(simulation.recording, size_m))
    )
    step = usual.interval_m
    at, shift = round((AT_M - usual.start_m) / step), round(size_m / step)
    kept = np.delete(np.arange(found.tracks[0].elevation.size), np.s_[at : at + shift])
    size = min(kept.size, usual.tracks[0].elevation.size)
    valid = found.tracks[0].valid[kept[:size]] & usual.tracks[0].valid[:size]
    z = found.tracks[0].elevation[kept[:size]]
    difference = np.abs(iri_trace(z, step) - iri_trace(usual.tracks[0].elevation[:size], step))
    near = slice(round(END_M / step), size - round(END_M / step))
    wide = round(ROUND_M / step)
    whole = valid[:-1] & valid[1:]
    sums = np.cumsum(np.where(whole, difference, 0.0)[near])
    return float(np.max(sums[wide:] - sums[:-wide])) / wide, step * float(np.sum(~valid[near]))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:channel distance. leaps")
@pytest.mark.parametrize("size_m", [0.3, 2.7])
@pytest.mark.parametrize(
    ("road", "grade_percent"), [("sayers-asphalt-long-waves", 0.0), ("sayers-normal", 6.0)]
)
@pytest.mark.parametrize(
    "pipeline", ["road-prior-smoother", "road-prior-smoother-spatial", "kalman-smoother"]
)
def test_a_leap_leaves_no_error_that_is_not_flagged(
    pipeline: str, road: str, grade_percent: float, size_m: float
) -> None:
    error, flagged_m = local_errors(drive(road, grade_percent), size_m, pipeline)
    assert error < LOCAL
    assert flagged_m < 10.0
