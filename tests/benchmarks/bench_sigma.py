"""How often the truth lies within two sigma of the Kalman smoothers' profiles.

Every published run is simulated, processed, and compared with the road under the laser, filtered
alike: along the encoder's own distance, whose error is that of the axis and not of the elevation,
and along the true distance. Usage:

    python tests/benchmarks/bench_sigma.py [--pipeline NAME] [--seeds N] [--run ID]
"""

import argparse
import warnings
from collections.abc import Iterator

import numpy as np
from kind_drives import KIND
from rich.console import Console
from rich.table import Table

import floatref
from floatref.measures import high_pass
from floatref.values.arrays import FloatArray
from floatref.values.profile import ProfileTrack
from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.proving_ground.simulate import Simulation, simulate

WAVELENGTH_M = 91.44
RUN_IN_M = 53.0
"""Left out at either end: there the filter runs in, and no point is valid."""


def within(error: FloatArray, sigma: FloatArray) -> float:
    """Return the share of points whose error is at most two sigma, in percent."""
    return 100.0 * float(np.mean(np.abs(error) <= 2.0 * sigma))


def compared(
    simulation: Simulation, track: ProfileTrack, interval_m: float
) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Yield errors in m, and sigma: along the encoder's distance, and along the true one."""
    motion, name = simulation.motion, track.name
    encoder = simulation.recording.channel("distance")
    encoder_m = np.interp(motion.times_s, encoder.times_s, encoder.values)
    points = interval_m * np.arange(track.elevation.size)
    for axis in (encoder_m, motion.distance):
        truth = high_pass(np.interp(points, axis, motion.tracks[name].road_m), interval_m)
        inside = slice(round(RUN_IN_M / interval_m), -round(RUN_IN_M / interval_m))
        assert track.sigma is not None
        yield (track.elevation - truth)[inside], track.sigma[inside]


def row(run: str, seed: int, pipeline: str) -> list[str]:
    simulation = simulate(scenario_of_run(run, seed, imu=True, gnss=True, **KIND))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        profile = floatref.process(simulation.recording, pipeline)
    cells = [run, str(seed)]
    for track in profile.tracks:
        (error, sigma), (plain, _) = compared(simulation, track, profile.interval_m)
        cells.append(f"{within(error, sigma):.1f}")
        cells.append(f"{1e3 * np.sqrt(np.mean(error**2)):.2f} / {1e3 * np.median(sigma):.2f}")
        cells.append(f"{within(plain, sigma):.1f}")
    return cells


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pipeline", default="kalman-smoother-reflection")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--run", action="append")
    asked = parser.parse_args()
    table = Table(title=f"{asked.pipeline}: truth within two sigma, percent of the points")
    table.add_column("run")
    table.add_column("seed", justify="right")
    for track in ("left", "right"):
        table.add_column(f"{track}, encoder's axis", justify="right")
        table.add_column("error rms / median sigma, mm", justify="right")
        table.add_column("true axis", justify="right")
    console = Console()
    for run in asked.run or RUNS:
        for seed in range(asked.seeds):
            cells = row(run, seed, asked.pipeline)
            console.print(" ".join(cells), highlight=False)
            table.add_row(*cells)
    console.print(table)


if __name__ == "__main__":
    main()
