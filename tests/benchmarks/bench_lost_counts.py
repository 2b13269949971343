"""How far counts that the encoder loses seconds before a brake spoil the stop.

Run `python tests/benchmarks/bench_lost_counts.py` for the figures of the page on triggered samples.
"""

import os
import warnings
from dataclasses import replace

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
from kind_drives import KIND

import floatref
from floatref.measures import high_pass
from floatref.values.recording import Recording
from floatref_conformance.proving_ground import Scenario, simulate

INTERVAL_M = 0.02
MARGIN = round(30.0 / INTERVAL_M)
LOST_AT_M = 180.0
STOP = Scenario(
    manoeuvre="stop",
    event_at_m=300.0,
    length_m=600.0,
    dwell_s=2.0,
    rate_hz=5000.0,
    profile_interval_m=INTERVAL_M,
    tracks=("left",),
    imu=False,
    gnss=False,
    **KIND,
)


def without_counts(recording: Recording, lost_s: float) -> tuple[Recording, float]:
    """Return ``recording`` whose encoder stands for ``lost_s``, and the way that it lost in m."""
    distance = recording.channel("distance", "left")
    values = distance.values.copy()
    begin = int(np.searchsorted(values, LOST_AT_M))
    end = begin + round(lost_s * STOP.rate_hz)
    lost_m = float(values[end] - values[begin])
    values[end:] -= lost_m
    values[begin:end] = values[begin]
    channels = (replace(c, values=values) if c is distance else c for c in recording.channels)
    return replace(recording, channels=tuple(channels)), lost_m


def largest_error(pipeline: str, seed: int, lost_s: float) -> float:
    """Return that of a run at valid points, 30 m or more from its ends, in mm."""
    simulation = simulate(replace(STOP, seed=seed))
    recording, lost_m = without_counts(simulation.recording, lost_s)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        (track,) = floatref.process(recording, pipeline, {"most_sigma_share": 2.0}).tracks
    true = high_pass(simulation.truth.track("left").elevation, INTERVAL_M)
    at = np.arange(track.elevation.size)
    behind = at * INTERVAL_M >= LOST_AT_M
    place = np.rint(at + behind * lost_m / INTERVAL_M).astype(int)
    checked = track.valid & (at >= MARGIN) & (place < true.size - MARGIN)
    return 1e3 * float(np.abs(track.elevation[checked] - true[place[checked]]).max())


def main() -> None:
    """Print a row for each pipeline."""
    print("largest error at valid points in mm, of two roads, by time without counts")
    for pipeline in ("road-prior-smoother-spatial", "road-prior-smoother"):
        found = (
            f"{1e3 * lost_s:.0f} ms: {max(largest_error(pipeline, s, lost_s) for s in (7, 8)):.1f}"
            for lost_s in (0.0, 0.02, 0.1)
        )
        print(f"{pipeline:28} " + ", ".join(found), flush=True)


if __name__ == "__main__":
    main()
