"""What the road prior loses by triggered samples: stops and creeping, by profile interval.

Run `python tests/benchmarks/bench_triggered_samples.py` for the figures of the page on it.
"""

import os
from dataclasses import replace

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
from kind_drives import KIND

import floatref
from floatref.measures import agreement, high_pass
from floatref_conformance.proving_ground import Scenario, Simulation, simulate

INTERVALS_M = (0.00508, 0.02, 0.05)
SEEDS = (7, 8)
FROM_TRIGGERS, FROM_ALL = "road-prior-smoother-spatial", "road-prior-smoother"
STOP = Scenario(
    manoeuvre="stop",
    event_at_m=150.0,
    length_m=310.0,
    rate_hz=5000.0,
    tracks=("left",),
    imu=False,
    gnss=False,
    **KIND,
)
DRIVES = {
    **{
        f"stop of {dwell_s:g} s, {g:g} g": replace(STOP, dwell_s=dwell_s, deceleration_g=g)
        for dwell_s, g in (
            (0.0, 0.2),
            (0.0, 0.35),
            (0.2, 0.2),
            (0.5, 0.35),
            (3.0, 0.35),
            (120.0, 0.2),
        )
    },
    **{
        f"creeping, {low:g} to {high:g} km/h": replace(
            STOP, manoeuvre="creeping", speed_kmh=low, event_speed_kmh=high, length_m=20.0 * high
        )
        for low, high in ((0.3, 2.0), (1.0, 4.0), (2.0, 8.0), (4.0, 12.0))
    },
}


def cross_correlation(simulation: Simulation, interval_m: float, pipeline: str) -> float:
    """Return that of a profile with the road, 60 m or a fifth of the run from its ends."""
    profile = floatref.process(simulation.recording, pipeline, {"interval_m": interval_m})
    true = high_pass(simulation.truth.track("left").elevation, interval_m)
    ours = profile.track("left").elevation
    size = min(true.size, ours.size)
    margin = min(round(60.0 / interval_m), size // 5)
    inside = slice(margin, size - margin)
    return agreement(true[inside], ours[inside], interval_m).cross_correlation


def main() -> None:
    """Print a row for each drive."""
    print(f"cross correlation, mean of {len(SEEDS)} roads; from triggers (from all samples)")
    print(f"{'':36}" + "".join(f"{1000 * each:>16g} mm" for each in INTERVALS_M))
    for vehicle in ("loaded-van", "soft-van"):
        for name, drive in DRIVES.items():
            row = ""
            for interval_m in INTERVALS_M:
                runs = [
                    simulate(replace(drive, seed=s, vehicle=vehicle, profile_interval_m=interval_m))
                    for s in SEEDS
                ]
                each = [
                    np.mean([cross_correlation(run, interval_m, pipeline) for run in runs])
                    for pipeline in (FROM_TRIGGERS, FROM_ALL)
                ]
                row += f"{each[0]:>11.3f} ({each[1]:.3f})"
            print(f"{vehicle + ', ' + name:36}{row}", flush=True)


if __name__ == "__main__":
    main()
